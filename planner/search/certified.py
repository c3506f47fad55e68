"""The certified search: the best grasps of a problem, with a proof that there are no better ones."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from planner.search.branch_and_bound import Before, BranchAndBound
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult, Status
from planner.search.settings import SearchSettings


@dataclass(frozen=True, kw_only=True)
class CertifiedSearch(SearchSettings):
    """Global optimum to a proven relative gap. Anytime: at a limit it returns its best grasp and the true gap.

    Raises:
        SettingError: When a setting is out of range.
    """

    def run(
        self,
        problem: SearchProblem,
        observe: Callable[[Progress], None] = lambda _: None,
        stop: Callable[[], bool] = lambda: False,
    ) -> SearchResult:
        """Search until the gap is proven, time is up, or the caller asks to stop.

        Args:
            problem: What to search.
            observe: Called with every line of the search log as it happens.
            stop: Asked again and again; once true, the search returns with what it has.
        """
        if self.apart > 0 and self.keep > 1:
            return self._run_distinct(problem, observe, stop)
        run = BranchAndBound(problem, self, observe, stop)
        return run.result(run.search())

    def _run_distinct(
        self, problem: SearchProblem, observe: Callable[[Progress], None], stop: Callable[[], bool]
    ) -> SearchResult:
        """One search for each grasp, without the subsets that are like the grasps before it; cuts are kept.

        The bound, the status, the cuts and the log of the result are those of the first search: they are about the
        best.
        """
        began, settings = time.perf_counter(), replace(self, keep=1, within=None)
        cuts = np.empty((0, problem.wrenches.shape[1]))
        results: list[SearchResult] = []
        while len(results) < self.keep:
            earlier = [grasp.subset for result in results for grasp in result.grasps]
            before = Before(began=began, subsets=earlier, cuts=list(cuts))
            run = BranchAndBound(problem, settings, observe, stop, before)
            result = run.result(run.search())
            cuts = run.cuts.directions
            worst = np.inf if self.within is None or not results else results[0].rho * (1 + self.within)
            if results and not result.rho <= min(worst, problem.force_ceiling):
                break
            results.append(result)
            if result.status is not Status.OPTIMAL:
                break
        return results[0].with_grasps(tuple(grasp for result in results for grasp in result.grasps))
