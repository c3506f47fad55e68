"""A binary tree over the candidates, so that one bound speaks for many subsets at once.

Candidates are ordered so that every node is a run [start, stop) of that order; a node is split into equal halves
across the longest side of its bounding box in (position, normal) space. Node 0 is the root; the two children of a
node have consecutive numbers, larger than its own.
"""

from dataclasses import dataclass

import numpy as np

from planner.contacts import Contacts

NORMAL_WEIGHT = 0.5
"""How much a unit of normal counts against a length of half the candidate cloud."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CandidateTree:
    """2n - 1 nodes over n candidates, numbered parents first, breadth first."""

    order: np.ndarray
    """Candidate at each position, shape (n,)."""

    start: np.ndarray
    """First position of each node, shape (2n - 1,)."""

    stop: np.ndarray
    """One past the last position of each node, shape (2n - 1,)."""

    left: np.ndarray
    """Left child of each node (the right one is the next number), -1 for leaves, shape (2n - 1,)."""

    levels: tuple[np.ndarray, ...]
    """Inner nodes of each depth, root first."""

    @property
    def sizes(self) -> np.ndarray:
        """Number of candidates below each node, shape (2n - 1,)."""
        return self.stop - self.start

    def maxima(self, values: np.ndarray) -> np.ndarray:
        """Largest value below each node: (n,) candidate values become (2n - 1,) node values."""
        leaves = self.left < 0
        best = np.empty(len(self.start))
        best[leaves] = values[self.order[self.start[leaves]]]
        for parents in reversed(self.levels):
            children = self.left[parents]
            best[parents] = np.maximum(best[children], best[children + 1])
        return best


def build_tree(contacts: Contacts) -> CandidateTree:
    """Split the candidates by position and normal until every leaf holds one."""
    points = contacts.points - contacts.points.mean(axis=0)
    radius = float(np.abs(points).max()) or 1.0
    features = np.hstack([points / radius, NORMAL_WEIGHT * contacts.normals])
    count = len(contacts)
    order = np.arange(count)
    start, stop, left = [0], [count], [-1]
    levels: list[np.ndarray] = []
    level = [0]
    while level:
        inner = [node for node in level if stop[node] - start[node] > 1]
        if inner:
            levels.append(np.array(inner))
        level = []
        for node in inner:
            first, last = start[node], stop[node]
            run = order[first:last]
            box = features[run]
            axis = int((box.max(axis=0) - box.min(axis=0)).argmax())
            order[first:last] = run[np.argsort(box[:, axis], kind="stable")]
            middle = (first + last) // 2
            left[node] = len(start)
            level += [len(start), len(start) + 1]
            start += [first, middle]
            stop += [middle, last]
            left += [-1, -1]
    return CandidateTree(
        order=order, start=np.array(start), stop=np.array(stop), left=np.array(left), levels=tuple(levels)
    )
