"""Where the heuristics start: a random subset that is a grasp at all."""

import time

import numpy as np

from planner.arrays import Indices
from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.early_exit import EarlyExit


def random_start(
    problem: SearchProblem, inner: EarlyExit, generator: np.random.Generator, deadline: float
) -> tuple[Indices, float]:
    """Random subsets until one resists W_R or the deadline (of `time.perf_counter`) passes; it and its rho [N]."""
    rho = np.inf
    while True:
        subset = generator.choice(len(problem.contacts), size=problem.fingers, replace=False)
        rho = inner.rho_below(subset, problem.force_ceiling)
        if np.isfinite(rho) or time.perf_counter() >= deadline:
            return subset, rho
