"""Bounds of rows of tree nodes from the cut table.

With U[C, k] = max of a_i(lambda_k) over the candidates below node C,

    1 / rho_N  <=  min_k sum_j U[C_j, k]      for every subset N the row (C_1, ..., C_m) stands for.

The table is kept in float32, for speed; its entries are raised by more than rounding can lower a sum, so that a bound
at or below the threshold in float32 is one in truth.
"""

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from scipy.cluster.hierarchy import leaves_list, ward

from planner.arrays import Indices, Mask, Singles
from planner.search.compiled.node_bounds import BLOCK, NO_BOUND, add_columns, bound_rows
from planner.search.cuts import CutTable
from planner.search.regions.region_tree import RegionTree
from planner.search.regions.rows import BoundedRows

FIRST_CUTS = 256
"""Columns of the table at the start; doubled when full."""

SPREAD = 64
"""Contacts by whose values cuts are compared."""

GROWTH = 1.5
"""Cuts are grouped again when their number has grown by this factor."""

MOST_GROUPED = 5000
"""Cuts up to which they are grouped: time and memory of the grouping grow with their square."""

CORES = min(4, os.cpu_count() or 1)
"""Threads that share the rows of a batch; the kernel does not hold the interpreter's lock."""

SMALLEST_SHARE = 256
"""Rows that are worth another thread."""

UNCHANGED = -1
"""In place of a column: no cut of the table bounds the row better than it was."""

RAISED = 1 + 1e-6
"""Above the error of a float32 sum of at most eight float32 numbers, (1 + 2^-24)^9."""


class NodeBounds:
    """U for all nodes, extended as the cut table grows."""

    def __init__(self, tree: RegionTree, cuts: CutTable) -> None:
        self._tree, self._cuts = tree, cuts
        self._spread = tree.spread(SPREAD)
        self._maxima = np.full((len(tree.left), FIRST_CUTS), NO_BOUND, dtype=np.float32)
        self._block_minima = np.full((len(tree.left), FIRST_CUTS // BLOCK), NO_BOUND, dtype=np.float32)
        self._cut_of_column = np.empty(0, dtype=np.int64)
        self._grouped = BLOCK
        self._threads = ThreadPoolExecutor(CORES)

    def extend(self) -> None:
        """Compute U for the cuts added since the last call."""
        while self._maxima.shape[1] < len(self._cuts):
            self._maxima, self._block_minima = _doubled(self._maxima), _doubled(self._block_minima)
        known, count = len(self._cut_of_column), len(self._cuts)
        if known == count:
            return
        values = RAISED * self._cuts.values[:, known:]
        add_columns(self._tree.left, self._tree.contact, values, self._maxima, self._block_minima, known)
        self._cut_of_column = np.append(self._cut_of_column, np.arange(known, count))
        if GROWTH * self._grouped <= count <= MOST_GROUPED:
            self._group()

    def _group(self) -> None:
        """Put cuts side by side that say much the same of a few spread candidates: whole blocks are then skipped."""
        count = len(self._cut_of_column)
        columns = leaves_list(ward(self._cuts.values[self._spread][:, self._cut_of_column].T))
        self._cut_of_column, self._grouped = self._cut_of_column[columns], count
        self._maxima[:, :count] = self._maxima[:, columns]
        self._block_minima = self._maxima[:, ::BLOCK].copy()
        for place in range(1, BLOCK):
            np.minimum(self._block_minima, self._maxima[:, place::BLOCK], out=self._block_minima)

    def bound(self, rows: BoundedRows, threshold: float) -> BoundedRows:
        """The rows with the best bounds that are known or found, each with its cut.

        Args:
            rows: With what is known of them, for example of their parents.
            threshold: Rows whose bound falls to this value or below need no better one [1/N].
        """
        lowered, pruned_at = np.minimum(rows.bounds, NO_BOUND).astype(np.float32), np.float32(threshold)
        columns = np.full(len(rows), UNCHANGED)
        blocks = -(-len(self._cut_of_column) // BLOCK)

        tables = self._maxima, self._block_minima

        def bound_some(some: slice) -> None:
            nodes = rows.nodes[some]
            bound_rows(tables, nodes, blocks, pruned_at, lowered[some], columns[some])

        list(self._threads.map(bound_some, _shares(len(rows))))
        better = columns != UNCHANGED
        bounds, cuts = rows.bounds.copy(), rows.cuts.copy()
        bounds[better], cuts[better] = lowered[better], self._cut_of_column[columns[better]]
        return BoundedRows(nodes=rows.nodes, bounds=bounds, cuts=cuts)

    def prunes(self, rows: Indices, threshold: float) -> Mask:
        """Which cuts prune which rows, shape (rows, cuts).

        Args:
            rows: Node numbers, shape (rows, m).
            threshold: Bound at or below which a row is pruned [1/N].
        """
        count = len(self._cut_of_column)
        sums = self._maxima[rows[:, 0], :count]
        for nodes in rows[:, 1:].T:
            sums += self._maxima[nodes, :count]
        prunes = np.empty(sums.shape, dtype=bool)
        prunes[:, self._cut_of_column] = sums <= np.float32(threshold)
        return prunes


def _shares(count: int) -> list[slice]:
    """Equal shares of rows, one for each core, not too small."""
    size = max(SMALLEST_SHARE, -(-count // CORES))
    return [slice(first, first + size) for first in range(0, count, size)]


def _doubled(table: Singles) -> Singles:
    """A table of twice as many columns, the new ones empty."""
    return np.hstack([table, np.full_like(table, NO_BOUND)])
