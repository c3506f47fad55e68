"""Points on the exact surface of an object's parts."""

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.graspable import Graspable


def project(rigid_object: Graspable, points: Floats, part: Indices, facet: Indices) -> tuple[Floats, Floats]:
    """Points of the exact surface nearest to given ones on given facets, and the inward unit normals there.

    Args:
        rigid_object: The object.
        points: Shape (n, d) [m].
        part: Part of each point, shape (n,).
        facet: Facet of each point, shape (n,).

    Returns:
        Two arrays of shape (n, d).
    """
    feet, normals = np.empty_like(points), np.empty_like(points)
    for index in np.unique(part):
        here = part == index
        feet[here], normals[here] = rigid_object.parts[index].project(points[here], facet[here])
    return feet, normals
