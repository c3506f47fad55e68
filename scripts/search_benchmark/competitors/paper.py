"""The paper's branch and bound, with a budget.

Its step 4 solves one Relaxed Problem for every subset, at least once. A random sample of them tells how long that
takes; where it is longer than the budget, the search is not even begun.
"""

import os
import time

import numpy as np

from planner.search.lower_bounds import CHUNK, LowerBounds
from planner.search.paper import MOST_SUBSETS, PaperSearch
from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.competitors.scattered import ScatteredSubsets
from scripts.search_benchmark.isolated import run_isolated

SAMPLES = 2
"""Chunks of subsets per core that are timed."""


def search_as_in_paper(problem: SearchProblem, gap: float, budget: float) -> Outcome:
    """Run it to the same gap, or say how long it would take at least."""
    first_pass = time_of_first_pass(problem)
    if problem.subsets <= MOST_SUBSETS and first_pass < budget:
        answer = run_isolated(_search, problem, gap, limit=budget)
        if answer is not None:
            return answer.value
        return Outcome(seconds=budget, finished=False, note="stopped")
    return Outcome(seconds=first_pass, finished=False, note="extrapolated: its first pass over the subsets alone")


def time_of_first_pass(problem: SearchProblem) -> float:
    """Seconds on all cores for one Relaxed Problem per subset, extrapolated from a sample."""
    subsets = ScatteredSubsets(len(problem.contacts), problem.fingers)
    cores = os.cpu_count() or 1
    sample = np.array([subsets[number] for number in range(min(len(subsets), SAMPLES * cores * CHUNK))])
    bounds = LowerBounds(problem, PaperSearch().bound, PaperSearch().sides)
    began = time.perf_counter()
    bounds.solve(sample, 0)
    return (time.perf_counter() - began) * len(subsets) / len(sample)


def _search(problem: SearchProblem, gap: float) -> Outcome:
    result = PaperSearch(epsilon=gap).run(problem)
    return Outcome(seconds=result.trace[-1].seconds, finished=True, rho=result.rho, lower_bound=result.lower_bound)
