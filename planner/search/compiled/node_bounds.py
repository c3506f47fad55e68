"""The table of node maxima, and bounds of rows of tree nodes from it.

The table has a row per node and a column per cut; every BLOCK columns share a column of their minima, so that blocks of
cuts that cannot prune a row are skipped unread.
"""

import numpy as np
from numba import njit

from planner.arrays import Floats, Indices, Singles
from planner.search.compiled.compile import compiled

BLOCK = 8
"""Cuts per block: one row of the table is read in runs of this many."""

NO_BOUND = 1e30
"""Stands for infinity in a table, whose arithmetic assumes finite numbers."""


@compiled("(i8[::1], i8[::1], f8[:, :], f4[:, ::1], f4[:, ::1], i8)")
def add_columns(
    left: Indices,
    candidates: Indices,
    values: Floats,
    maxima: Singles,
    block_minima: Singles,
    first: int,
) -> None:
    """Fill columns of the table: the largest value below each node.

    Args:
        left: Left child of each node, the right one is the next number; -1 for leaves; shape (nodes,).
        candidates: A candidate below each node, shape (nodes,).
        values: Value of each candidate in each new column, shape (n, new).
        maxima: The table, changed in place, shape (nodes, columns).
        block_minima: Smallest entry of each block of columns, changed in place, shape (nodes, columns / BLOCK).
        first: The first new column; those before it are filled.
    """
    for node in range(len(left) - 1, -1, -1):
        child = left[node]
        for new in range(values.shape[1]):
            column = first + new
            if child < 0:
                value = np.float32(values[candidates[node], new])
            else:
                value = max(maxima[child, column], maxima[child + 1, column])
            maxima[node, column] = value
            block_minima[node, column // BLOCK] = min(block_minima[node, column // BLOCK], value)


@njit(inline="always")
def _add_up(table: Singles, nodes: Indices, first: int, count: int, sums: Singles) -> None:
    """Sum `count` columns of the nodes' rows of a table, from column `first`."""
    row = table[nodes[0]]
    for column in range(count):
        sums[column] = row[first + column]
    for slot in range(1, len(nodes)):
        row = table[nodes[slot]]
        for column in range(count):
            sums[column] += row[first + column]


@compiled("(UniTuple(f4[:, ::1], 2), i8[:, ::1], i8, f4, f4[::1], i8[::1])", reorder=True)
def bound_rows(
    tables: tuple[Singles, Singles],
    rows: Indices,
    blocks: int,
    threshold: float,
    bounds: Singles,
    cuts: Indices,
) -> None:
    """Lower the bounds of rows until a cut prunes them or no cut can; those that are pruned already stay as they are.

    Only blocks whose minima sum to the threshold or less are read, no cut of the others can prune; where there is none,
    the most promising one is read for the bound it gives.

    Args:
        tables: U, shape (nodes, at least blocks * BLOCK), and the smallest U of each block, shape (nodes, at least
            blocks) [1/N].
        rows: Node numbers, shape (rows, m).
        blocks: Blocks in use.
        threshold: Rows whose bound falls to this value or below are pruned [1/N].
        bounds: Valid upper bounds on 1 / rho of the rows, lowered in place, shape (rows,) [1/N].
        cuts: Column of the cut that gave each bound, or unchanged where none lowered it, set in place, shape (rows,).
    """
    maxima, block_minima = tables
    sums = np.empty(BLOCK, np.float32)
    promise = np.empty(blocks, np.float32)
    for row in range(len(rows)):
        if bounds[row] <= threshold:
            continue
        nodes = rows[row]
        _add_up(block_minima, nodes, 0, blocks, promise)
        least = np.float32(NO_BOUND)
        for block in range(blocks):
            least = min(least, promise[block])
        limit = max(threshold, least)
        for block in range(blocks):
            if promise[block] > limit:
                continue
            first = block * BLOCK
            _add_up(maxima, nodes, first, BLOCK, sums)
            least = sums[0]
            for cut in range(BLOCK):
                least = min(least, sums[cut])
            if least < bounds[row]:
                bounds[row] = least
                cut = 0
                while sums[cut] != least:
                    cut += 1
                cuts[row] = first + cut
                if least <= threshold:
                    break
