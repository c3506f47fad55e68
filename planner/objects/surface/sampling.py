"""Random points on triangles, with equal density per area."""

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.coincident import covered_parts, finger_parts
from planner.objects.vectors import norm


def whole_surface(rigid_object: RigidObject) -> tuple[Floats, Indices, Indices]:
    """Triangles of the parts, shape (n, 3, 3) [m], and the part and the facet of each, shape (n,).

    Parts that others hold are left out: they are no surface of the object.
    """
    covered = covered_parts(rigid_object)
    return _surface(rigid_object, [index for index in range(len(rigid_object.parts)) if index not in covered])


def finger_surface(rigid_object: RigidObject) -> tuple[Floats, Indices, Indices]:
    """The same of the parts whose surface is for fingers."""
    return _surface(rigid_object, finger_parts(rigid_object))


def _surface(rigid_object: RigidObject, parts: list[int]) -> tuple[Floats, Indices, Indices]:
    surfaces = [rigid_object.parts[index].triangles() for index in parts]
    triangles = np.concatenate([triangles for triangles, _ in surfaces])
    facets = np.concatenate([facets for _, facets in surfaces])
    return triangles, np.repeat(parts, [len(each) for _, each in surfaces]), facets


def areas(triangles: Floats) -> Floats:
    """Of triangles of shape (n, 3, 3) [m]: shape (n,) [m^2]."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return norm(np.cross(edges[:, 0], edges[:, 1])) / 2


def random_points(triangles: Floats, count: int, generator: np.random.Generator) -> tuple[Floats, Indices]:
    """`count` points, uniform over the area of triangles of shape (n, 3, 3), and the triangle each lies on."""
    summed_areas = areas(triangles).cumsum()
    where = generator.random(count) * summed_areas[-1]
    index = summed_areas.searchsorted(where, side="right").clip(max=len(triangles) - 1)
    across, along = np.sqrt(generator.random(count))[:, None], generator.random(count)[:, None]
    a, b, c = triangles[index].transpose(1, 0, 2)
    return a + across * ((b - a) + along * (c - b)), index
