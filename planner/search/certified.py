"""The certified search: branch and bound on the cut table, with cuts made where they are needed.

    pop rows of tree nodes, split them, bound the children by min_k sum_j U[C_j, k];
    prune a child when its bound is at most 1 / level, with level = rho / (1 + gap) of the incumbent;
    evaluate a child that is a single subset: either a new cut prunes it, or it is the new incumbent.

When no row is open, no subset beats the level, and the cuts that pruned are the proof. With another level (see
`planner.search.incumbents`) the same search returns the k best grasps, or all within a tolerance, proven complete.
"""

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from planner.errors import SettingError
from planner.search.closure import impossible_direction
from planner.search.cuts import CutTable
from planner.search.evaluation import Evaluator
from planner.search.frontier import Frontier, split
from planner.search.incumbents import SOLVER_ACCURACY, Incumbents
from planner.search.local_search import STARTS, add_vertex_cuts, evaluate_below, improve
from planner.search.node_bounds import NodeBounds
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult, Status, relative_gap
from planner.search.tree import build_tree
from planner.search.two_fingers import line_bounds, pairs

logger = logging.getLogger(__name__)

BATCH = 512
"""Rows split together."""


@dataclass(frozen=True, kw_only=True)
class CertifiedSearch:
    """Global optimum to a proven relative gap. Anytime: at a limit it returns its best grasp and the true gap.

    Raises:
        SettingError: When a setting is out of range.
    """

    gap: float = 1e-3
    """Stop when rho / lower_bound - 1 is proven to be at most this."""

    time_limit: float = np.inf
    """Seconds after which the search stops with the gap it has."""

    keep: int = 1
    """How many grasps to return: the k best, or with `within` at most so many."""

    within: float | None = None
    """Return all grasps whose rho exceeds the best by at most this, relatively: ties and near-ties, none missing."""

    seed: int = 0
    """Seed of the starts of the local search; the proof does not depend on it."""

    def __post_init__(self) -> None:
        if not 0 <= self.gap < np.inf:
            raise SettingError(f"the gap is {self.gap}; it must be 0 or more, for example 1e-3")
        if not self.time_limit >= 0:
            raise SettingError(f"the time limit is {self.time_limit} s; it must be 0 or more")
        if self.seed < 0:
            raise SettingError(f"the seed is {self.seed}; it must be 0 or more")
        if self.keep < 1:
            raise SettingError(f"{self.keep} grasps are asked for; ask for at least 1")
        if self.within is not None and not 0 <= self.within < np.inf:
            raise SettingError(f"the tolerance is {self.within}; it must be 0 or more, for example 0.01")

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
        run = _Run(problem, self, observe, stop)
        return run.result(run.search())


class _Run:
    """State of one certified search."""

    def __init__(
        self,
        problem: SearchProblem,
        method: CertifiedSearch,
        observe: Callable[[Progress], None],
        stop: Callable[[], bool],
    ) -> None:
        self.problem, self.method, self.observe, self.stop = problem, method, observe, stop
        self.began = time.perf_counter()
        self.evaluator = Evaluator(problem)
        self.cuts = CutTable(problem)
        self.tree = build_tree(problem.contacts)
        self.bounds = NodeBounds(self.tree, self.cuts)
        self.frontier = Frontier(problem.fingers)
        self.frontier.push(np.zeros((1, problem.fingers), dtype=np.int64), np.array([np.inf]))
        self.incumbents = Incumbents(problem.force_ceiling, method.gap, method.keep, method.within)
        self.pruned_bound = 0.0  # largest bound on 1 / rho among everything pruned or evaluated
        self.nodes = 0
        self.trace: list[Progress] = []

    @property
    def threshold(self) -> float:
        """Rows bounded by this hold nothing that is wanted [1/N]."""
        return 1 / self.incumbents.level

    def halted(self) -> Status | None:
        """Why the search has to end before its proof is complete, if it has to."""
        if self.stop():
            return Status.INTERRUPTED
        return Status.TIME_LIMIT if time.perf_counter() - self.began > self.method.time_limit else None

    def search(self) -> Status:
        add_vertex_cuts(self.cuts)
        if self.problem.fingers == 2 and self.problem.contacts.dimension == 3:
            return self.search_pairs()
        self.start_incumbent()
        if self.incumbents.best is None and self.impossible_at_once():
            return Status.INFEASIBLE
        self.log()
        while len(self.frontier):
            if status := self.halted():
                return status
            self.advance()
            if time.perf_counter() - self.began > 2 * self.trace[-1].seconds + 0.5:
                self.log()
        return self.proven_status()

    def search_pairs(self) -> Status:
        """Two fingers in space: the moment about their line settles most pairs, the rest are evaluated."""
        self.log()
        possible = []
        for subsets in pairs(self.problem):
            if status := self.halted():
                return status
            possible.append(subsets[self.drop(line_bounds(self.problem, subsets))])
            self.nodes += len(subsets)
        for subset in np.concatenate(possible):
            if status := self.halted():
                return status
            self.evaluate(subset)
        self.frontier.pop(1)
        return self.proven_status()

    def proven_status(self) -> Status:
        """What the bounds of everything pruned amount to, once nothing is open."""
        if self.incumbents.best is None:
            return Status.INFEASIBLE if self.pruned_bound <= self.threshold else Status.UNRESOLVED
        gap = relative_gap(self.incumbents.rho, self.lower_bound())
        return Status.OPTIMAL if gap <= max(self.method.gap, SOLVER_ACCURACY) else Status.UNRESOLVED

    def start_incumbent(self) -> None:
        """Local search from random subsets."""
        generator = np.random.default_rng(self.method.seed)
        for _ in range(STARTS):
            start = generator.choice(len(self.problem.contacts), size=self.problem.fingers, replace=False)
            improve(self.evaluator, self.cuts, start, self.incumbents, lambda: self.halted() is not None)

    def impossible_at_once(self) -> bool:
        """Whether one direction shows that even all candidates together cannot resist W_R; if so, it is the proof."""
        direction = impossible_direction(self.problem)
        cut = None if direction is None else self.cuts.evaluate(direction)
        if cut is None:
            return False
        bound = float(np.sort(cut.values)[-self.problem.fingers :].sum())
        if bound > self.threshold:
            return False
        self.cuts.add(cut)
        self.frontier.pop(1)
        self.pruned_bound, self.bounds.useful = bound, {len(self.cuts) - 1}
        return True

    def advance(self) -> None:
        """Split the most recent open rows, prune, and evaluate the single subsets among their children."""
        rows, _ = self.frontier.pop(BATCH)
        self.nodes += len(rows)
        children = split(rows, self.tree)
        self.bounds.extend()
        bounds = self.bounds.bound(children, self.threshold)
        open_ = self.drop(bounds)
        children, bounds = children[open_], bounds[open_]
        single = (self.tree.sizes[children] == 1).all(axis=1)
        self.frontier.push(children[~single], bounds[~single])
        best_first = np.argsort(-bounds[single], kind="stable")
        leaves, bounds = children[single][best_first], bounds[single][best_first]
        for done, row in enumerate(leaves):
            if self.halted():
                self.frontier.push(leaves[done:], bounds[done:])  # still open: the bound must not forget them
                return
            self.evaluate(np.sort(self.tree.order[self.tree.start[row]]))

    def drop(self, bounds: np.ndarray) -> np.ndarray:
        """Which bounds exceed the threshold; the largest of the others is remembered."""
        open_ = bounds > self.threshold
        self.pruned_bound = max(self.pruned_bound, float(bounds[~open_].max(initial=0.0)))
        return open_

    def evaluate(self, subset: np.ndarray) -> None:
        """Decide a single subset: pruned by a cut, or evaluated and offered to the incumbents."""
        if self.cuts.bound(subset)[0] > self.threshold and subset not in self.incumbents:
            wanted = evaluate_below(self.evaluator, self.cuts, subset, self.incumbents.level)
            if wanted is not None:
                self.incumbents.offer(wanted)
        bound, cut = self.cuts.bound(subset)
        self.bounds.useful.add(cut)
        self.pruned_bound = max(self.pruned_bound, bound)

    def lower_bound(self) -> float:
        """No subset has a smaller rho [N]; claims beyond the force ceiling are not made."""
        weakest = max(self.pruned_bound, self.frontier.weakest_bound)
        if self.incumbents.best is not None:
            weakest = max(weakest, self.cuts.bound(self.incumbents.best.subset)[0])
        ceiling = self.problem.force_ceiling
        return min(1 / weakest, ceiling) if weakest > 0 else ceiling

    def log(self) -> None:
        line = Progress(
            seconds=time.perf_counter() - self.began,
            nodes=self.nodes,
            open=len(self.frontier),
            lower_bound=self.lower_bound(),
            incumbent=self.incumbents.rho,
            socp_solves=self.evaluator.solves,
            cuts=len(self.cuts),
        )
        self.trace.append(line)
        self.observe(line)

    def result(self, status: Status) -> SearchResult:
        """The end state, with the open rows bounded by all cuts."""
        if len(self.frontier):
            self.bounds.extend()
            rows, _ = self.frontier.pop(len(self.frontier))
            bounds = self.bounds.bound(rows, self.threshold)
            open_ = self.drop(bounds)
            self.frontier.push(rows[open_], bounds[open_])
            self.bounds.useful.update(range(len(self.cuts)))  # any of them may bound what is still open
        self.bounds.useful.update(self.cuts.bound(grasp.subset)[1] for grasp in self.incumbents.grasps)
        self.log()
        return SearchResult(
            problem=self.problem,
            method="certified",
            status=status,
            grasps=self.incumbents.grasps,
            lower_bound=self.lower_bound(),
            directions=self.cuts.directions[sorted(self.bounds.useful)],
            trace=tuple(self.trace),
        )
