"""Multisets of tree nodes: each stands for all subsets that take their contacts from below those nodes.

A row (C_1, ..., C_m) lists nodes in the order of their positions; distinct nodes are disjoint, and a node that
appears r times gives r different candidates. The row (root, ..., root) stands for every m-subset. Splitting a
node that appears r times sends t copies left and r - t right, t = 0..r: the children partition the parent's
subsets, so no subset is met twice.
"""

import numpy as np

from planner.search.tree import CandidateTree


def split(rows: np.ndarray, tree: CandidateTree) -> tuple[np.ndarray, np.ndarray]:
    """Children of rows, each split at its widest node.

    Args:
        rows: Node numbers, shape (rows, m); every row holds a node of at least two candidates.

    Returns:
        Child rows, shape (children, m), and the row each comes from, shape (children,).
    """
    sizes = tree.sizes
    slot = tree.diameters[rows].argmax(axis=1)  # first copy of the widest node; its other copies follow it
    node = rows[np.arange(len(rows)), slot]
    copies = (rows == node[:, None]).sum(axis=1)
    children, parents_of = [], []
    for count in np.unique(copies):
        chosen = np.flatnonzero(copies == count)
        parents, first, split_node = rows[chosen], slot[chosen], node[chosen]
        left = tree.left[split_node]
        for lefts in range(count + 1):
            possible = (sizes[left] >= lefts) & (sizes[left + 1] >= count - lefts)
            child = parents[possible].copy()
            index = np.arange(len(child))
            for copy in range(count):
                child[index, first[possible] + copy] = left[possible] + (copy >= lefts)
            children.append(child)
            parents_of.append(chosen[possible])
    return np.concatenate(children), np.concatenate(parents_of)


class Frontier:
    """A stack of open rows with their bounds; the last pushed are popped first, so memory stays small."""

    def __init__(self, fingers: int) -> None:
        self._rows = np.empty((1024, fingers), dtype=np.int64)
        self._bounds = np.empty(1024)
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def rows(self) -> np.ndarray:
        """Open rows, shape (open, m)."""
        return self._rows[: self._count]

    @property
    def weakest_bound(self) -> float:
        """Largest upper bound on 1 / rho among the open rows; 0 when none is open [1/N]."""
        return float(self._bounds[: self._count].max(initial=0.0))

    def push(self, rows: np.ndarray, bounds: np.ndarray) -> None:
        """Push rows, the most promising (largest bound) last, so that they are popped first."""
        order = np.argsort(bounds, kind="stable")
        needed = self._count + len(rows)
        while needed > len(self._rows):
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)])
            self._bounds = np.concatenate([self._bounds, np.empty_like(self._bounds)])
        self._rows[self._count : needed] = rows[order]
        self._bounds[self._count : needed] = bounds[order]
        self._count = needed

    def pop(self, count: int) -> tuple[np.ndarray, np.ndarray]:
        """Take up to `count` rows and their bounds from the top."""
        first = max(0, self._count - count)
        rows, bounds = self._rows[first : self._count].copy(), self._bounds[first : self._count].copy()
        self._count = first
        return rows, bounds
