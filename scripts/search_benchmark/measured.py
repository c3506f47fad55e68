"""Everything about one instance, and whether all who solved it agree."""

import logging
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec

from planner.search.problem import SearchProblem
from planner.search.result import Status
from scripts.search_benchmark.budgets import Budgets
from scripts.search_benchmark.certified import Certified, measure_certified, verify
from scripts.search_benchmark.competitors.enumeration import enumerate_subsets
from scripts.search_benchmark.competitors.mixed_integer import solve_with_cuts
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.competitors.paper import search_as_in_paper
from scripts.search_benchmark.heuristics import Trials, try_heuristics
from scripts.search_benchmark.instances import Instance

logger = logging.getLogger(__name__)

ACCURACY = 1e-5
"""Relative accuracy to which the inner solver's rho of one subset is trusted."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Measured:
    """One instance, solved by everyone."""

    instance: Instance
    candidates: int
    fingers: int
    subsets: int
    certified: Certified

    outcomes: dict[str, Outcome]
    """Of the competitors that prove their answer."""

    trials: dict[str, Trials]
    """Of those that do not; empty for the instances of the curves alone."""

    def disagreements(self) -> Iterator[str]:
        """Sentences about answers that contradict each other; none if all is well."""
        run, gap = self.certified.run, self.instance.gap
        if run.status is not Status.OPTIMAL:
            yield f"{self.instance.name}: the certified search ended as {run.status}"
        if self.certified.proven is False:
            yield f"{self.instance.name}: the verifier refutes the lower bound {run.lower_bound:.6g} N"
        for name, outcome in self.outcomes.items():
            if outcome.finished and abs(outcome.rho / run.rho - 1) > gap + ACCURACY:
                yield f"{self.instance.name}: {name} finds {outcome.rho:.6g} N, the certified search {run.rho:.6g} N"
            if outcome.lower_bound > run.rho * (1 + ACCURACY):
                yield f"{self.instance.name}: {name} bounds by {outcome.lower_bound:.6g} N what is {run.rho:.6g} N"
        found = {name: outcome.rho for name, outcome in self.outcomes.items()}
        found |= {name: float(trials.rho.min()) for name, trials in self.trials.items()}
        for name, rho in found.items():
            if rho < run.lower_bound * (1 - ACCURACY):
                yield f"{self.instance.name}: {name} finds {rho:.6g} N, below the proven {run.lower_bound:.6g} N"


def measure(instance: Instance, budgets: Budgets, *, in_tables: bool) -> Measured:
    """Solve one instance in every way.

    Args:
        instance: What to solve.
        budgets: How much time everyone gets.
        in_tables: Whether to run the verifier and the heuristics too.

    Raises:
        ObjectError: When its object is not there.
    """
    problem = instance.problem()
    logger.info("%s: %d candidates, %.3g subsets", instance.name, len(problem.contacts), problem.subsets)
    certified = measure_certified(problem, instance.gap, budgets.runs, budgets.search_limit)
    run = certified.run
    logger.info("  certified search: %s, rho %.6g N, %.3g s", run.status, run.rho, run.seconds)
    trials: dict[str, Trials] = {}
    if in_tables:
        certified = verify(problem, certified, budgets.verify_limit)
        logger.info("  verifier: proven %s, %.3g s", certified.proven, certified.verifier_seconds)
        trials = try_heuristics(problem, max(run.seconds, run.processor_seconds), budgets.seeds, budgets.heuristic)
        for name, each in trials.items():
            logger.info("  %s: best rho %.6g N of %d seeds", name, each.rho.min(), len(each.rho))
    return Measured(
        instance=instance,
        candidates=len(problem.contacts),
        fingers=problem.fingers,
        subsets=problem.subsets,
        certified=certified,
        outcomes=dict(_outcomes(problem, instance.gap, budgets)),
        trials=trials,
    )


def _outcomes(problem: SearchProblem, gap: float, budgets: Budgets) -> Iterator[tuple[str, Outcome]]:
    """Every competitor's name and outcome."""
    competitors: dict[str, Callable[[], Outcome]] = {
        "enumeration": lambda: enumerate_subsets(problem, budgets.competitor),
        "paper": lambda: search_as_in_paper(problem, gap, budgets.paper),
        "mixed-integer cuts, HiGHS": lambda: solve_with_cuts(problem, gap, budgets.competitor),
    }
    if find_spec("pyscipopt"):
        from scripts.search_benchmark.competitors.mixed_integer_cone import solve_as_cone_program  # slow: CVXPY

        competitors["mixed-integer cones, SCIP"] = lambda: solve_as_cone_program(problem, gap, budgets.competitor)
    for name, compete in competitors.items():
        outcome = compete()
        at_least = "" if outcome.finished else "more than "
        logger.info("  %s: %s%.3g s, rho %.6g N %s", name, at_least, outcome.seconds, outcome.rho, outcome.note)
        yield name, outcome
