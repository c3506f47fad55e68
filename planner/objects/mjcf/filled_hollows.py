"""Hollows of a mesh that MuJoCo fills, because a mesh geom collides as its convex hull."""

from collections.abc import Sequence

import numpy as np

from planner.arrays import Floats
from planner.objects.mjcf.compiled import CompiledObject
from planner.objects.rigid_object import ConvexPart

FILLED_HOLLOW = 0.2
"""A hull of which more than this share lies outside its mesh deserves a warning, or a decomposition."""


def filled_hollows(compiled: CompiledObject, parts: Sequence[ConvexPart]) -> dict[int, float]:
    """Share of the hull that lies outside the mesh, for the parts where that is much; wrong for open meshes.

    Args:
        compiled: The compiled object.
        parts: One for each of its colliding geoms, in that order.
    """
    shares = {}
    for geom in compiled.meshes(colliding=True):
        vertices, faces = compiled.mesh(geom)
        part = compiled.colliding.index(geom)
        share = 1 - abs(_volume(vertices[faces])) / _volume(parts[part].triangles()[0])
        if share > FILLED_HOLLOW:
            shares[part] = share
    return shares


def _volume(triangles: Floats) -> float:
    """Signed volume inside a closed surface (divergence theorem), from triangles of shape (n, 3, 3) [m^3]."""
    arms = triangles - triangles[0, 0]
    return float((arms[:, 0] * np.cross(arms[:, 1], arms[:, 2])).sum() / 6)
