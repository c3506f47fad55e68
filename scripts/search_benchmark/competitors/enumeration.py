"""Every subset, by Clarabel, on all cores: one process each, which share the best rho found.

A subset is left at the first wrench that asks for more than the best. What is left when the budget is spent needs at
least one inner problem per subset, and that bounds the time of a full enumeration from below.
"""

import multiprocessing
import os
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing.sharedctypes import Synchronized
from typing import NamedTuple

import numpy as np

from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.early_exit import EarlyExit
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.competitors.scattered import ScatteredSubsets


class Share(NamedTuple):
    """What one process did."""

    tested: int
    solves: int
    seconds: float


def enumerate_subsets(problem: SearchProblem, budget: float) -> Outcome:
    """Test all subsets, or as many as the budget allows [s]; the processes' start is not counted."""
    cores = os.cpu_count() or 1
    context = multiprocessing.get_context("forkserver")
    least = context.Value("d", problem.force_ceiling)
    with ProcessPoolExecutor(cores, context, initializer=_receive, initargs=(least,)) as pool:
        shares = list(pool.map(_test, [problem] * cores, range(cores), [cores] * cores, [budget] * cores))
    found = least.value if least.value < problem.force_ceiling else np.inf
    seconds, tested = max(share.seconds for share in shares), sum(share.tested for share in shares)
    left = problem.subsets - tested
    if not left:
        return Outcome(seconds=seconds, finished=True, rho=found, lower_bound=found)
    per_solve = seconds / sum(share.solves for share in shares)
    return Outcome(
        seconds=seconds + left * per_solve,
        finished=False,
        rho=found,
        note=f"extrapolated from {100 * tested / problem.subsets:.2g} % done",
    )


_least: "Synchronized[float]"
"""Best rho of all processes [N]; each receives it when it starts."""


def _receive(least: "Synchronized[float]") -> None:
    global _least
    _least = least


def _test(problem: SearchProblem, first: int, step: int, budget: float) -> Share:
    """Test the subsets number first, first + step, ... until none or no time is left."""
    subsets, inner = ScatteredSubsets(len(problem.contacts), problem.fingers), EarlyExit(problem)
    began = time.perf_counter()
    tested = 0
    for number in range(first, problem.subsets, step):
        rho = inner.rho_below(subsets[number], _least.value)
        if np.isfinite(rho):
            with _least.get_lock():
                _least.value = min(_least.value, rho)
        tested += 1
        if time.perf_counter() - began > budget:
            break
    return Share(tested, inner.solves, time.perf_counter() - began)
