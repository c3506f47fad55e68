"""Grasps unlike those already found.

Two grasps are alike when every contact of the one lies within a distance of some contact of the other. With d_i the
distance from candidate i to the nearest contact of an earlier grasp, a subset is like that grasp iff max_i d_i is below
the distance; so the maxima of d below each node of the tree tell which rows hold nothing else.
"""

from collections.abc import Sequence

import numpy as np

from planner.search.problem import SearchProblem
from planner.search.regions.candidate_tree import CandidateTree


class Apart:
    """Which rows hold subsets that are unlike every earlier grasp."""

    def __init__(
        self, problem: SearchProblem, tree: CandidateTree, earlier: Sequence[np.ndarray], apart: float
    ) -> None:
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

    def possible(self, rows: np.ndarray) -> np.ndarray:
        """Which rows may hold a subset unlike all, shape (rows,).

        Args:
            rows: Node numbers, shape (rows, m).
        """
        return self._far(self._farthest, rows)

    def admit(self, subsets: np.ndarray) -> np.ndarray:
        """Which subsets are unlike all earlier grasps, shape (subsets,).

        Args:
            subsets: Candidate indices, shape (subsets, m).
        """
        return self._far(self._distances, subsets)

    def admits(self, subset: np.ndarray) -> bool:
        """Whether one subset, shape (m,), is unlike all earlier grasps."""
        return bool(self.admit(subset[None])[0])

    def _far(self, distances: list[np.ndarray], chosen: np.ndarray) -> np.ndarray:
        """Where one of the chosen is far enough from each earlier grasp, shape (rows,)."""
        far = np.ones(len(chosen), dtype=bool)
        for each in distances:
            far &= each[chosen].max(axis=1) >= self._apart
        return far
