"""Farthest-point sampling: each new point is the one farthest from all points chosen before.

The pool is kept in blocks of neighbours. A new point can only shorten distances in blocks whose bounding box it
reaches, so most blocks are skipped; the choice is the same as without them, in time n^1.5.
Source: Gonzalez, Clustering to minimize the maximum intercluster distance (1985).
"""

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.neighbour_blocks import neighbour_blocks


def farthest_points(pool: Floats, count: int) -> Indices:
    """Indices of `count` points of the pool, the first being point 0.

    Args:
        pool: Shape (n, 3), n >= count [m].
        count: At least 1.

    Returns:
        Shape (count,), in the order they were chosen.
    """
    order = neighbour_blocks(pool)
    blocks = pool[order]
    lower, upper = blocks.min(axis=1), blocks.max(axis=1)
    distances = np.full(order.shape, np.inf)
    farthest = np.full(len(order), np.inf)
    chosen = np.empty(count, dtype=int)
    newest = 0
    for step in range(count):
        chosen[step] = newest
        point = pool[newest]
        outside = np.maximum(lower - point, point - upper).clip(min=0)
        reached = np.flatnonzero(_squared(outside) < farthest)
        distances[reached] = np.minimum(distances[reached], _squared(blocks[reached] - point))
        farthest[reached] = distances[reached].max(axis=1)
        block = int(farthest.argmax())
        newest = int(order[block, distances[block].argmax()])
    return chosen


def _squared(vectors: Floats) -> Floats:
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return x * x + y * y + z * z
