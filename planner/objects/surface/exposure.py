"""Which points of the parts' surfaces are on the outside of their union, where a finger can reach them.

A point p of part k with outward normal n is reachable if neither p + 1e-6 size n nor p + 1e-2 size n lies inside
another part. The first probe finds what other parts cover: faces glued together are inside, while coplanar
faces of overlapping parts stay outside. The second finds the cracks that convex decompositions leave between
parts, too narrow for any fingertip.
"""

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.objects.graspable import Graspable
from planner.objects.part import Part
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.coincident import covered_parts

PROBES = (1e-6, 1e-2)
"""Heights above the surface at which other parts are asked, relative to the object's size."""

FINGERTIP = 0.005
"""Radius, unless given, of the fingertip that must fit beside other parts' walls, relative to the object's size."""

SEAM = 1e-3
"""Share of its radius by which a fingertip on one of two coplanar faces may reach into the other; at least the height
of the first probe."""


def exposed(rigid_object: Graspable, points: Floats, normals: Floats, part: Indices) -> Mask:
    """Whether surface points are on the outer surface of the union.

    Parts that others hold are not asked: what lies outside of those lies outside of them.

    Args:
        rigid_object: The object.
        points: Points on the surfaces of parts, shape (n, d) [m].
        normals: Inward unit normals there, shape (n, d).
        part: Index of the part each point belongs to, shape (n,).

    Returns:
        Shape (n,), boolean.
    """
    outside = np.ones(len(points), dtype=bool)
    for height in PROBES:
        probes = points - height * rigid_object.size * normals
        for index, other in _holders(rigid_object):
            lower, upper = other.bounds()
            asked = np.flatnonzero(outside & (part != index) & ((probes > lower) & (probes < upper)).all(axis=1))
            outside[asked] = other.depth(probes[asked]) <= 0
    return outside


def reachable(
    rigid_object: Graspable, points: Floats, normals: Floats, part: Indices, fingertip: float | None = None
) -> Mask:
    """Whether a fingertip touching the outer surface at a point keeps clear of all other parts.

    The fingertip is a ball. Distances to other parts are taken to the
    planes of their facets, so near a seam a little more than necessary is given up. Parts that others hold are not
    asked here either.

    Args:
        rigid_object: The object.
        points: Points on the surfaces of parts, shape (n, d) [m].
        normals: Inward unit normals there, shape (n, d).
        part: Index of the part each point belongs to, shape (n,).
        fingertip: Its radius [m]; by default FINGERTIP times the object's size.

    Returns:
        Shape (n,), boolean.
    """
    clear = exposed(rigid_object, points, normals, part)
    radius = FINGERTIP * rigid_object.size if fingertip is None else fingertip
    centers, slack = points - radius * normals, max(SEAM * radius, PROBES[0] * rigid_object.size)
    for index, other in _holders(rigid_object):
        lower, upper = other.bounds()
        near = ((centers > lower - radius) & (centers < upper + radius)).all(axis=1)
        asked = np.flatnonzero(clear & (part != index) & near)
        clear[asked] = other.depth(centers[asked]) <= slack - radius
    return clear


def _holders(rigid_object: Graspable) -> list[tuple[int, Part]]:
    """The parts that no other holds, numbered."""
    held = covered_parts(rigid_object) if isinstance(rigid_object, RigidObject) else {}
    return [(index, part) for index, part in enumerate(rigid_object.parts) if index not in held]
