"""Grasps unlike those already found.

Two grasps are alike when every contact of the one lies within a distance of some contact of the other. With d_i the
distance from candidate i to the nearest contact of an earlier grasp, a subset is like that grasp iff max_i d_i is below
the distance; so the maxima of d below each region tell which rows hold nothing else. That is for regions of candidates:
along a patch d is not convex, and its maximum need not be at a corner.
"""

from collections.abc import Sequence

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.search.problem import SearchProblem
from planner.search.regions.region_tree import RegionTree


class Distinct:
    """A contact far from every contact of each earlier grasp; see `Constraint`."""

    def __init__(self, problem: SearchProblem, tree: RegionTree, earlier: Sequence[Indices], apart: float) -> None:
        """
        Args:
            problem: Whose candidates are chosen from.
            tree: Over those candidates.
            earlier: Subsets already found, shape (m,) each.
            apart: Least distance of some contact to every contact of each of them [m].
        """
        points = problem.contacts.points
        self._apart = apart
        self._distances = [
            np.linalg.norm(points[:, None] - points[subset], axis=2).min(axis=1, initial=np.inf) for subset in earlier
        ]
        self._farthest = [tree.boxes(distances[:, None])[1][:, 0] for distances in self._distances]

    def possible(self, rows: Indices) -> Mask:
        """See `Constraint.possible`."""
        return self._far(self._farthest, rows)

    def admits(self, subsets: Indices) -> Mask:
        """See `Constraint.admits`."""
        return self._far(self._distances, subsets)

    def stated(self) -> dict[str, float]:
        """Nothing: the certificate is about the best grasp, before which there is none."""
        return {}

    def _far(self, distances: list[Floats], chosen: Indices) -> Mask:
        """Where one of the chosen is far enough from each earlier grasp, shape (rows,)."""
        far = np.ones(len(chosen), dtype=bool)
        for each in distances:
            far &= each[chosen].max(axis=1) >= self._apart
        return far
