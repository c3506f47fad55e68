"""Contacts that are neither too close to each other nor too far apart.

The points of a region lie in its bounding box, so two boxes that are everywhere closer than the spacing, or everywhere
farther apart than the span, hold no pair that is wanted. For single candidates this is exact.
"""

from itertools import combinations

import numpy as np

from planner.arrays import Indices, Mask
from planner.search.problem import SearchProblem
from planner.search.regions.region_tree import RegionTree


class Spacing:
    """The distances of any two contacts that are wanted; see `Constraint`."""

    def __init__(self, problem: SearchProblem, tree: RegionTree) -> None:
        self._needed = problem.pairs_are_limited
        self._least, self._most, self._points = problem.least_distance, problem.span, problem.contacts.points
        if self._needed:
            self._lower, self._upper = tree.boxes(problem.contacts.points)

    def possible(self, rows: Indices) -> Mask:
        """See `Constraint.possible`."""
        possible = np.ones(len(rows), dtype=bool)
        if self._needed:
            for first, second in combinations(rows.T, 2):
                gaps = np.maximum(self._lower[second] - self._upper[first], self._lower[first] - self._upper[second])
                reach = np.maximum(self._upper[second] - self._lower[first], self._upper[first] - self._lower[second])
                possible &= np.linalg.norm(np.maximum(gaps, 0.0), axis=1) <= self._most
                possible &= np.linalg.norm(reach, axis=1) >= self._least
        return possible

    def admits(self, subsets: Indices) -> Mask:
        """See `Constraint.admits`."""
        wanted = np.ones(len(subsets), dtype=bool)
        if self._needed:
            for first, second in combinations(subsets.T, 2):
                distances = np.linalg.norm(self._points[first] - self._points[second], axis=1)
                wanted &= (distances >= self._least) & (distances <= self._most)
        return wanted

    def stated(self) -> dict[str, float]:
        """Least and greatest distance [m]."""
        return {"spacing": self._least, "span": self._most}
