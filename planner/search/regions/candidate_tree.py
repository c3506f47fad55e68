"""A binary tree over the candidates, so that one bound speaks for many subsets at once.

Candidates are ordered so that every node is a run [start, stop) of that order; a node is split in the middle of the
longest side of its bounding box in (position, normal) space: small boxes, not equal counts, make tight bounds. Node 0
is the root; the two children of a node have consecutive numbers, larger than its own.
"""

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.search.problem import SearchProblem
from planner.search.regions.region_tree import RegionTree

SMALLEST = 1e-12
"""Diameter of a node whose candidates coincide."""

HALVED_AFTER = 48
"""Depth below which nodes are split into equal counts: crowds of almost equal candidates cannot make a deep tree."""


def build_tree(problem: SearchProblem) -> RegionTree:
    """Split the candidates of each kind of finger by position and normal until every leaf holds one.

    The diameter of a region is the diagonal of its bounding box in (position, normal) space, lengths in radii of the
    candidate cloud.
    """
    points = problem.contacts.points - problem.contacts.points.mean(axis=0)
    radius = float(np.abs(points).max()) or 1.0
    features = np.hstack([points / radius, problem.contacts.normals])
    order = np.arange(len(features))
    stops = np.cumsum([kind.candidates for kind in problem.all_kinds])
    starts = np.concatenate([[0], stops[:-1]])
    levels: list[tuple[Indices, Indices, Indices, Floats]] = []
    nodes = 0
    while len(starts):
        inner = stops - starts > 1
        children = nodes + len(starts) + 2 * np.cumsum(inner) - 2
        diameters, middles = _split_level(features, order, starts[inner], stops[inner], len(levels) > HALVED_AFTER)
        levels.append((starts, stops, np.where(inner, children, -1), _spread(diameters, inner)))
        nodes += len(starts)
        starts, stops = (
            np.stack([starts[inner], middles], axis=1).ravel(),
            np.stack([middles, stops[inner]], axis=1).ravel(),
        )
    start, stop, left, diameter = (np.concatenate(column) for column in zip(*levels, strict=True))
    return RegionTree(
        order=order,
        left=left,
        contact=order[start],
        sizes=stop - start,
        diameters=diameter,
        first_row=problem.kind_of_finger,
    )


def _split_level(
    features: Floats, order: Indices, starts: Indices, stops: Indices, halve: bool
) -> tuple[Floats, Indices]:
    """Sort the candidates of each node along its longest side, in place, and find where the upper half begins.

    Args:
        features: Position and normal of each candidate, shape (n, 2 d).
        order: Candidate at each position, shape (n,), changed within the runs.
        starts: First position of each node, shape (nodes,); every node holds at least two candidates.
        stops: One past its last position, shape (nodes,).
        halve: Whether to split into equal counts instead of at the middle of the side.

    Returns:
        Diameter of each node and position of the first candidate of its upper half, shape (nodes,) each.
    """
    if not len(starts):
        return np.empty(0), np.empty(0, dtype=np.int64)
    sizes = stops - starts
    runs = np.cumsum(sizes) - sizes  # where each node begins among the positions of this level
    node = np.repeat(np.arange(len(starts)), sizes)
    position = np.arange(len(node)) - runs[node] + starts[node]
    below = features[order[position]]
    lower, upper = np.minimum.reduceat(below, runs), np.maximum.reduceat(below, runs)
    sides = upper - lower
    axis = sides.argmax(axis=1)
    value = below[np.arange(len(node)), axis[node]]
    order[position] = order[position[np.lexsort((value, node))]]
    longest = sides.max(axis=1)
    middle = (lower + sides / 2)[np.arange(len(starts)), axis]
    lows = np.add.reduceat((value <= middle[node]).astype(np.int64), runs).clip(1, sizes - 1)
    lows = np.where((longest == 0) | halve, sizes // 2, lows)
    return np.maximum(np.linalg.norm(sides, axis=1), SMALLEST), starts + lows


def _spread(values: Floats, chosen: Mask) -> Floats:
    """The values at the chosen places, zero elsewhere."""
    spread = np.zeros(len(chosen))
    spread[chosen] = values
    return spread
