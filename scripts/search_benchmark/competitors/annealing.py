"""Simulated annealing: swap one contact at a time, accept worse grasps less and less readily.

A swap is accepted with probability min(1, exp(-(rho' / rho - 1) / T)). The random number is drawn first, so that a swap
is left as soon as one wrench shows that it will not be accepted.
"""

import time

import numpy as np
from scipy.spatial import cKDTree

from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.early_exit import EarlyExit
from scripts.search_benchmark.competitors.random_start import random_start

HOT, COLD = 0.3, 1e-3
"""First and last temperature T, relative to rho; between them it falls geometrically with time."""

NEIGHBOURS = 16
"""Half of the swaps go to one of so many nearest candidates, the others anywhere."""


def anneal(problem: SearchProblem, seconds: float, seed: int) -> float:
    """Best rho found in the given time [N]; infinite where no grasp was found.

    Args:
        problem: What to search.
        seconds: How long.
        seed: Of the start and the swaps.
    """
    began = time.perf_counter()
    generator, inner = np.random.default_rng(seed), EarlyExit(problem)
    points = problem.contacts.points
    near = cKDTree(points).query(points, k=min(NEIGHBOURS + 1, len(points)))[1]
    subset, rho = random_start(problem, inner, generator, began + seconds)
    best = rho
    while (elapsed := (time.perf_counter() - began) / seconds) < 1:
        temperature = HOT * (COLD / HOT) ** elapsed
        swapped = subset.copy()
        slot = generator.integers(problem.fingers)
        choices = near[subset[slot]] if generator.random() < 0.5 else len(points)
        swapped[slot] = generator.choice(choices)
        if swapped[slot] in subset:
            continue
        level = rho * (1 + temperature * generator.exponential())
        candidate = inner.rho_below(swapped, level)
        if candidate < level:
            subset, rho = swapped, candidate
            best = min(best, rho)
    return best
