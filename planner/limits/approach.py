"""A finger must come to its contact on a straight way, past the other parts and above the table."""

import numpy as np

from planner.arrays import Floats, Mask
from planner.candidates.candidates import Candidates
from planner.limits.clear_path import keeps_clear
from planner.limits.limits import Limits
from planner.limits.obstacles import HalfSpace, Obstacle, obstacles
from planner.limits.table import table_height
from planner.objects.graspable import Graspable
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.surface.exposure import SEAM


def approachable(rigid_object: Graspable, candidates: Candidates, limits: Limits) -> Mask:
    """Whether the fingertip's way to each candidate is free, shape (n,).

    The fingertip is a ball of radius r that comes over a length l along the inward normal n of the contact p. Its
    way is the capsule of the points within r of the segment

        { p - t n : r <= t <= r + l },

    and free if it enters neither a part nor, where a table is given, the table; it may touch them: what is less than
    SEAM r deep counts as touching, as in `reachable`. It touches the contact's own part at p and cannot enter it,
    for that part is convex; in the plane, the same holds for the contact's own edge. Unlike `reachable`, distances
    are exact, for fingers are not small beside the facets of walls.
    """
    if limits.approach is None:
        return np.ones(len(candidates), dtype=bool)
    radius, length = limits.approach.radius, limits.approach.length
    contacts = candidates.contacts
    starts = contacts.points - radius * contacts.normals
    ends = starts - length * contacts.normals
    if isinstance(rigid_object, PlanarObject):  # an outline is more than its edges
        free, own = rigid_object.outline.depth(starts) <= 0, candidates.facet
    else:
        free, own = np.ones(len(candidates), dtype=bool), candidates.part
    for index, obstacle in enumerate(_obstacles(rigid_object, limits)):
        near = _boxes_meet(obstacle, starts, ends, radius)
        for asked in np.flatnonzero(free & near & (own != index)):
            free[asked] = keeps_clear(obstacle, starts[asked], ends[asked], (1 - SEAM) * radius)
    return free


def _obstacles(rigid_object: Graspable, limits: Limits) -> list[Obstacle]:
    """The object's parts or edges in their order, then the table."""
    table = limits.table
    below = [HalfSpace(up=table.up, height=table_height(rigid_object, table))] if table else []
    return [*obstacles(rigid_object), *below]


def _boxes_meet(obstacle: Obstacle, starts: Floats, ends: Floats, radius: float) -> Mask:
    """Whether the bounding boxes of the ways, shape (n,), meet the obstacle's."""
    lower, upper = obstacle.bounds()
    above = (np.maximum(starts, ends) + radius >= lower).all(axis=1)
    return above & (np.minimum(starts, ends) - radius <= upper).all(axis=1)
