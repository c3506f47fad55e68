"""Farthest-point sampling: each new point is the one farthest from all points chosen before.

The pool is kept in blocks of neighbours. A new point can only shorten distances in blocks whose bounding box it
reaches, so most blocks are skipped; the choice is the same as without them, in time n^1.5.
Source: Gonzalez, Clustering to minimize the maximum intercluster distance (1985).
"""

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.neighbour_blocks import neighbour_blocks


def farthest_points(pool: Floats, count: int, partners: Floats | None = None, spacing: Floats | None = None) -> Indices:
    """Indices of `count` points of the pool, the first being point 0.

    Args:
        pool: Shape (n, 3), n >= count [m].
        count: At least 1.
        partners: A point that is chosen together with each, from which the next is to be far too, shape (n, 3) [m].
        spacing: Positive, shape (n,): the distances to a point are counted in this unit, so that the points that are
            chosen lie this much closer or farther apart, relatively; by default alike everywhere.

    Returns:
        Shape (count,), in the order they were chosen.
    """
    order = neighbour_blocks(pool)
    blocks, units = pool[order], np.ones(order.shape) if spacing is None else (spacing * spacing)[order]
    lower, upper, coarsest = blocks.min(axis=1), blocks.max(axis=1), units.max(axis=1)
    distances = np.full(order.shape, np.inf)
    farthest = np.full(len(order), np.inf)
    chosen = np.empty(count, dtype=int)
    newest = 0
    for step in range(count):
        chosen[step] = newest
        for point in (pool[newest],) if partners is None else (pool[newest], partners[newest]):
            outside = np.maximum(lower - point, point - upper).clip(min=0)
            reached = np.flatnonzero(_squared(outside) < farthest * coarsest)
            away = _squared(blocks[reached] - point) / units[reached]
            distances[reached] = np.minimum(distances[reached], away)
            farthest[reached] = distances[reached].max(axis=1)
        block = int(farthest.argmax())
        newest = int(order[block, distances[block].argmax()])
    return chosen


def _squared(vectors: Floats) -> Floats:
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return x * x + y * y + z * z
