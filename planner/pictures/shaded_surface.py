"""The surface of a part as graphics cards shade it: smooth where it is curved, sharp where it turns."""

import numpy as np

from planner.arrays import Floats
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.rigid_object import ConvexPart


def shaded_surface(part: ConvexPart) -> Floats:
    """Corners of a part's triangles with their exact outward normals, shape (3 triangles, 6)."""
    triangles, facets = part.triangles()
    corners = triangles.reshape(-1, 3)
    if isinstance(part, Polyhedron):  # its normals do not change over a facet
        return np.hstack([corners, part.outward_normals[np.repeat(facets, 3)]])
    _, inward = part.project(corners, np.repeat(facets, 3))
    return np.hstack([corners, -inward])
