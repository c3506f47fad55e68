"""Which parts of an object coincide: a surface that several parts share is one surface of their union."""

from collections.abc import Mapping
from functools import cache, lru_cache
from types import MappingProxyType

import numpy as np

from planner.arrays import Floats, Mask
from planner.objects.graspable import Graspable
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.rigid_object import ConvexPart, RigidObject

ON_SURFACE = 1e-6
"""Distance, relative to the object's size, within which a point lies on a surface."""

INSIDE = 5e-7
"""How far a part may stand out of another, relative to the object's size, and still lie inside: less than the height
at which points are asked whether they are exposed."""


@lru_cache(maxsize=1)
def covered_parts(rigid_object: RigidObject) -> Mapping[int, int]:
    """Parts that add nothing to the union because another holds them, each with that other.

    Of parts that coincide the first stays. A polyhedron is inside if its corners are; a curved part is asked at the
    corners of its tessellation and above the middle of each triangle. The answer for the last object is kept: every
    step of a command asks for it.
    """
    margin = INSIDE * rigid_object.size
    parts, bounds = rigid_object.parts, np.array([part.bounds() for part in rigid_object.parts])
    covered: dict[int, int] = {}

    @cache
    def inside(index: int, other: int) -> bool:
        return _inside(parts[index], parts[other], margin)

    for index in range(len(parts)):
        around = (bounds[:, 0] <= bounds[index, 0] + margin) & (bounds[:, 1] >= bounds[index, 1] - margin)
        for other in np.flatnonzero(around.all(axis=1)).tolist():
            if other == index or other in covered or not inside(index, other):
                continue
            if other < index or not inside(other, index):
                covered[index] = other
                break
    return MappingProxyType(covered)


def finger_parts(rigid_object: Graspable) -> list[int]:
    """Parts whose surface is for fingers: those that they may touch, without what another of these holds."""
    touchable = rigid_object.touchable
    covered = covered_parts(rigid_object) if isinstance(rigid_object, RigidObject) else {}
    held = {part for part, other in covered.items() if touchable[other]}
    return [index for index in np.flatnonzero(touchable).tolist() if index not in held]


def parts_through(rigid_object: Graspable, points: Floats) -> Mask:
    """Which parts have each point of the outside of the union on their surface, shape (points, parts).

    Args:
        rigid_object: The object.
        points: On the outside, shape (n, d) [m].
    """
    margin = ON_SURFACE * rigid_object.size
    through = np.zeros((len(points), len(rigid_object.parts)), dtype=bool)
    for index, part in enumerate(rigid_object.parts):
        lower, upper = part.bounds()
        near = np.flatnonzero(((points > lower - margin) & (points < upper + margin)).all(axis=1))
        through[near, index] = part.depth(points[near]) >= -margin
    return through


def _inside(part: ConvexPart, other: ConvexPart, margin: float) -> bool:
    """Whether no point of a part stands out of the other by more than the margin [m]."""
    if isinstance(part, Polyhedron):
        return bool((other.depth(part.vertices) >= -margin).all())
    triangles, facets = part.triangles()
    corners = np.unique(triangles.reshape(-1, 3), axis=0)
    middles, _ = part.project(triangles.mean(axis=1), facets)
    return bool((other.depth(np.concatenate([corners, middles])) >= -margin).all())
