"""Rows of regions: each stands for all subsets that take their contacts from below its nodes.

A row (C_1, ..., C_m) lists nodes in the order of their positions; distinct nodes are disjoint, and a node that
appears r times gives r different contacts. The row (root, ..., root) stands for every m-subset. Splitting a
node that appears r times sends t copies left and r - t right, t = 0..r: the children partition the parent's
subsets, so no subset is met twice.

A bound without its cut proves nothing to anyone else. So the two travel together: from a row to its children, through
the frontier, to the moment where the bound prunes and its cut becomes part of the proof.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.search.regions.region_tree import RegionTree

NO_CUT = -1
"""Stands for the cut of a bound that is still infinite."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BoundedRows:
    """Rows, a bound on each, and the cut that proves it."""

    nodes: Indices
    """Node numbers, shape (rows, m)."""

    bounds: Floats
    """Upper bound on 1 / rho of every subset a row stands for, shape (rows,) [1/N]; infinite where none is known."""

    cuts: Indices
    """The cut that gave each bound, shape (rows,); NO_CUT where the bound is infinite."""

    @classmethod
    def unbounded(cls, nodes: Indices) -> "BoundedRows":
        """Rows, shape (rows, m), of which nothing is known."""
        return cls(nodes=nodes, bounds=np.full(len(nodes), np.inf), cuts=np.full(len(nodes), NO_CUT))

    def __len__(self) -> int:
        return len(self.nodes)

    def __getitem__(self, which: Indices | Mask | slice) -> "BoundedRows":
        """Some of the rows, by mask, by index, or a run of them."""
        return BoundedRows(nodes=self.nodes[which], bounds=self.bounds[which], cuts=self.cuts[which])


def split(rows: BoundedRows, tree: RegionTree) -> BoundedRows:
    """Children of rows, each split at its widest node; they inherit its bound with the cut that proves it.

    Args:
        rows: Every one holds a node of some width.
        tree: To which the nodes belong.
    """
    nodes, sizes = rows.nodes, tree.sizes
    slot = tree.diameters[nodes].argmax(axis=1)  # first copy of the widest node; its other copies follow it
    node = nodes[np.arange(len(nodes)), slot]
    copies = (nodes == node[:, None]).sum(axis=1)
    children, parents_of = [], []
    for count in np.unique(copies):
        chosen = np.flatnonzero(copies == count)
        parents, first, split_node = nodes[chosen], slot[chosen], node[chosen]
        left = tree.left[split_node]
        for lefts in range(count + 1):
            possible = (sizes[left] >= lefts) & (sizes[left + 1] >= count - lefts)
            child = parents[possible].copy()
            index = np.arange(len(child))
            for copy in range(count):
                child[index, first[possible] + copy] = left[possible] + (copy >= lefts)
            children.append(child)
            parents_of.append(chosen[possible])
    parents = np.concatenate(parents_of)
    return BoundedRows(nodes=np.concatenate(children), bounds=rows.bounds[parents], cuts=rows.cuts[parents])


class Frontier:
    """A stack of open rows; the last pushed are popped first, so memory stays small."""

    def __init__(self, fingers: int) -> None:
        self._stored = BoundedRows.unbounded(np.zeros((1024, fingers), dtype=np.int64))
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def weakest_bound(self) -> float:
        """Largest upper bound on 1 / rho among the open rows; 0 when none is open [1/N]."""
        return float(self._stored.bounds[: self._count].max(initial=0.0))

    def push(self, rows: BoundedRows) -> None:
        """Push rows, the most promising (largest bound) last, so that they are popped first."""
        needed = self._count + len(rows)
        while needed > len(self._stored):
            self._stored = self._stored[np.arange(2 * len(self._stored)) % len(self._stored)]
        ordered, free = rows[np.argsort(rows.bounds, kind="stable")], slice(self._count, needed)
        self._stored.nodes[free], self._stored.bounds[free] = ordered.nodes, ordered.bounds
        self._stored.cuts[free] = ordered.cuts
        self._count = needed

    def pop(self, count: int) -> BoundedRows:
        """Take up to `count` rows from the top."""
        taken = np.arange(max(0, self._count - count), self._count)  # an index copies, a slice would not
        self._count -= len(taken)
        return self._stored[taken]
