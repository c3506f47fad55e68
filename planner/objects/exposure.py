"""Which points of the parts' surfaces are on the outside of their union, where a finger can reach them.

A point p of part k with outward normal n is reachable if neither p + 1e-6 size n nor p + 1e-2 size n lies inside
another part. The first probe finds what other parts cover: faces glued together are inside, while coplanar
faces of overlapping parts stay outside. The second finds the cracks that convex decompositions leave between
parts, too narrow for any fingertip.
"""

import numpy as np

from planner.objects.rigid_object import RigidObject

PROBES = (1e-6, 1e-2)
"""Heights above the surface at which other parts are asked, relative to the object's size."""


def exposed(rigid_object: RigidObject, points: np.ndarray, normals: np.ndarray, part: np.ndarray) -> np.ndarray:
    """Whether surface points are on the outer surface of the union.

    Args:
        rigid_object: The object.
        points: Points on the surfaces of parts, shape (n, 3) [m].
        normals: Inward unit normals there, shape (n, 3).
        part: Index of the part each point belongs to, shape (n,).

    Returns:
        Shape (n,), boolean.
    """
    outside = np.ones(len(points), dtype=bool)
    for height in PROBES:
        probes = points - height * rigid_object.size * normals
        for index, other in enumerate(rigid_object.parts):
            lower, upper = other.bounds()
            asked = np.flatnonzero(outside & (part != index) & ((probes > lower) & (probes < upper)).all(axis=1))
            outside[asked] = other.depth(probes[asked]) <= 0
    return outside
