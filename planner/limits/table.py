"""The object stands on a table: no contact below it or so near that a finger would touch it."""

import numpy as np

from planner.arrays import Mask
from planner.candidates.candidates import Candidates
from planner.limits.limits import Limits, Table
from planner.limits.obstacles import obstacles
from planner.objects.graspable import Graspable

FAR = 1e6
"""Distance of the point from which the lowest point is seen, relative to the object's size."""


def above_table(rigid_object: Graspable, candidates: Candidates, limits: Limits) -> Mask:
    """Whether up . p >= height + clearance for each candidate, shape (n,)."""
    if limits.table is None:
        return np.ones(len(candidates), dtype=bool)
    heights = (candidates.contacts.points * limits.table.up).sum(axis=1)
    return heights >= table_height(rigid_object, limits.table) + limits.table.clearance


def table_height(rigid_object: Graspable, table: Table) -> float:
    """min up . p over the object where no height is given [m].

    The lowest point of a convex set is the one nearest to a point far below; seen from FAR it is found to within
    1 / FAR of the object's size.
    """
    if table.height is not None:
        return table.height
    lower, upper = np.array([part.bounds() for part in rigid_object.parts]).swapaxes(0, 1)
    middle = (lower.min(axis=0) + upper.max(axis=0)) / 2
    far_below = middle - FAR * rigid_object.size * table.up
    return float(min(table.up @ obstacle.nearest(far_below) for obstacle in obstacles(rigid_object)))
