"""Heuristics with the certified search's own time, from many seeds: how often they miss what it proves, and how far."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.annealing import anneal
from scripts.search_benchmark.competitors.restarts import restart

HEURISTICS: dict[str, Callable[[SearchProblem, float, int], float]] = {
    "simulated annealing": anneal,
    "random restarts": restart,
}
"""Problem, seconds and seed in, best rho out."""

FEWEST_SEEDS = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class Trials:
    """One heuristic from many seeds."""

    seconds: float
    """Of each seed."""

    rho: Floats
    """Best found from each seed, shape (seeds,) [N]; infinite where no grasp was found."""

    def excess(self, rho: float, gap: float) -> Floats:
        """rho_seed / rho - 1 of the seeds that miss rho by more than the gap, ascending."""
        excess = self.rho / rho - 1
        return np.sort(excess[excess > gap])


def try_heuristics(problem: SearchProblem, seconds: float, seeds: int, limit: float) -> dict[str, Trials]:
    """Every heuristic from seeds 0, 1, ..., `seconds` each; fewer seeds where all would take more than `limit`."""
    tried = min(seeds, max(FEWEST_SEEDS, int(limit / seconds)))
    return {
        name: Trials(seconds=seconds, rho=np.array([heuristic(problem, seconds, seed) for seed in range(tried)]))
        for name, heuristic in HEURISTICS.items()
    }
