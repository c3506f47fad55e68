"""Random restarts: from a random grasp, swap one contact for a better one until no swap is, and start again."""

import time

import numpy as np

from planner.arrays import Indices
from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.early_exit import EarlyExit
from scripts.search_benchmark.competitors.random_start import random_start


def restart(problem: SearchProblem, seconds: float, seed: int) -> float:
    """Best rho found in the given time [N]; infinite where no grasp was found.

    Args:
        problem: What to search.
        seconds: How long.
        seed: Of the starts and of the order of the swaps.
    """
    deadline = time.perf_counter() + seconds
    generator, inner = np.random.default_rng(seed), EarlyExit(problem)
    best = np.inf
    while time.perf_counter() < deadline:
        subset, rho = random_start(problem, inner, generator, deadline)
        best = min(best, descend(problem, inner, subset, rho, generator, deadline))
    return best


def descend(
    problem: SearchProblem,
    inner: EarlyExit,
    subset: Indices,
    rho: float,
    generator: np.random.Generator,
    deadline: float,
) -> float:
    """rho of a grasp that no single swap improves, or of the one reached at the deadline [N]."""
    fingers, count = problem.fingers, len(problem.contacts)
    swaps = generator.permutation(fingers * count)
    subset, untried, next_swap = subset.copy(), len(swaps), 0
    while untried and time.perf_counter() < deadline:
        slot, candidate = divmod(int(swaps[next_swap]), count)
        next_swap = (next_swap + 1) % len(swaps)
        untried -= 1
        if candidate in subset:
            continue
        swapped = subset.copy()
        swapped[slot] = candidate
        better = inner.rho_below(swapped, rho)
        if better < rho:
            subset, rho, untried = swapped, better, len(swaps)
    return rho
