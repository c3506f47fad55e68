"""Rows of tree nodes, each with what is known of it: a bound, and the cut that proves that bound.

A bound without its cut proves nothing to anyone else. So the two travel together: from a row to its children, through
the frontier, to the moment where the bound prunes and its cut becomes part of the proof.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Indices, Mask

NO_CUT = -1
"""Stands for the cut of a bound that is still infinite."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BoundedRows:
    """Multisets of tree nodes, see `planner.search.regions.frontier`, and a bound on each."""

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
