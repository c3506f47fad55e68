"""Points in blocks of neighbours of one size, so that whole blocks can be left out of a search."""

import math

import numpy as np

from planner.arrays import Floats, Indices

SMALLEST_BLOCK = 128
"""Points per block of a small pool; large pools have blocks of a quarter of their square root, measured best."""


def neighbour_blocks(pool: Floats) -> Indices:
    """Indices of the pool's points in blocks of neighbours, shape (blocks, size); a few points appear twice."""
    block = max(SMALLEST_BLOCK, math.isqrt(len(pool)) // 4)
    return halved(pool, max(0, math.ceil(math.log2(len(pool) / block))))


def halved(pool: Floats, halvings: int) -> Indices:
    """The same in 2^halvings blocks: each is halved at the middle of its longest extent, as often as that.

    Blocks 2 b and 2 b + 1 are the halves of block b of one halving less. Some points appear twice, or more often if
    there are more blocks than points.
    """
    order = np.resize(np.arange(len(pool)), (1, -(-len(pool) // 2**halvings) * 2**halvings))
    for _ in range(halvings):
        points = pool[order]
        longest = np.ptp(points, axis=1).argmax(axis=1)
        keys = np.take_along_axis(points, longest[:, None, None], axis=2)[:, :, 0]
        order = np.take_along_axis(order, keys.argsort(axis=1, kind="stable"), axis=1)
        order = order.reshape(2 * len(order), -1)
    return order
