"""Random points on triangles, with equal density per area."""

import numpy as np

from planner.objects.rigid_object import RigidObject
from planner.objects.vectors import norm


def whole_surface(rigid_object: RigidObject) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles of all parts, shape (n, 3, 3) [m], and the part and the facet of each, shape (n,)."""
    surfaces = [part.triangles() for part in rigid_object.parts]
    triangles = np.concatenate([triangles for triangles, _ in surfaces])
    facets = np.concatenate([facets for _, facets in surfaces])
    return triangles, np.repeat(np.arange(len(surfaces)), [len(each) for _, each in surfaces]), facets


def touchable_surface(rigid_object: RigidObject) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """`whole_surface` of the parts that fingers may touch."""
    triangles, part, facet = whole_surface(rigid_object)
    touchable = rigid_object.touchable[part]
    return triangles[touchable], part[touchable], facet[touchable]


def areas(triangles: np.ndarray) -> np.ndarray:
    """Of triangles of shape (n, 3, 3) [m]: shape (n,) [m^2]."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return norm(np.cross(edges[:, 0], edges[:, 1])) / 2


def random_points(triangles: np.ndarray, count: int, generator: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """`count` points, uniform over the area of triangles of shape (n, 3, 3), and the triangle each lies on."""
    summed_areas = areas(triangles).cumsum()
    where = generator.random(count) * summed_areas[-1]
    index = summed_areas.searchsorted(where, side="right").clip(max=len(triangles) - 1)
    across, along = np.sqrt(generator.random(count))[:, None], generator.random(count)[:, None]
    a, b, c = triangles[index].transpose(1, 0, 2)
    return a + across * ((b - a) + along * (c - b)), index
