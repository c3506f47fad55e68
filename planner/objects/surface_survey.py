"""What part of the collision surface a finger can reach, from random points on all parts."""

from typing import NamedTuple

import numpy as np

from planner.objects.exposure import exposed, reachable
from planner.objects.projection import project
from planner.objects.rigid_object import RigidObject
from planner.objects.sampling import areas, random_points, whole_surface

SAMPLES = 20_000
"""Random points: shares come out to half a percent."""

SAME_PLANE = 1e-6
"""Distance, relative to the object's size, within which a point lies on a surface."""


class SurfaceSurvey(NamedTuple):
    """Areas in m^2; curved parts count with the area of their tessellation, 1 % too small at most."""

    whole: float
    """Area of all parts, hidden or not."""

    outer: float
    """Area of the outside of their union."""

    reachable: float
    """Area of the outside where a fingertip fits beside other parts' walls, of the parts that fingers may touch."""

    samples: int
    """Random points asked."""

    unreachable_samples: int
    """How many of them no fingertip reaches."""


def survey_surface(rigid_object: RigidObject, fingertip: float | None = None) -> SurfaceSurvey:
    """Survey the surface with the same random points every time.

    Args:
        rigid_object: The object.
        fingertip: Radius of the fingertip [m]; by default a share of the object's size.
    """
    triangles, part, facet = whole_surface(rigid_object)
    drawn, index = random_points(triangles, SAMPLES, np.random.Generator(np.random.PCG64(0)))
    points, normals = project(rigid_object, drawn, part[index], facet[index])
    outside = exposed(rigid_object, points, normals, part[index])
    reached = reachable(rigid_object, points, normals, part[index], fingertip) & rigid_object.touchable[part[index]]
    whole = float(areas(triangles).sum())
    shares = 1 / _surfaces_through(rigid_object, points)
    return SurfaceSurvey(
        whole=whole,
        outer=whole * float((outside * shares).mean()),
        reachable=whole * float((reached * shares).mean()),
        samples=SAMPLES,
        unreachable_samples=int((~reached).sum()),
    )


def _surfaces_through(rigid_object: RigidObject, points: np.ndarray) -> np.ndarray:
    """How many parts have each point of the outside on their surface, so that coplanar faces count once."""
    margin = SAME_PLANE * rigid_object.size
    count = np.zeros(len(points))
    for part in rigid_object.parts:
        lower, upper = part.bounds()
        near = np.flatnonzero(((points > lower - margin) & (points < upper + margin)).all(axis=1))
        count[near] += part.depth(points[near]) >= -margin
    return np.maximum(count, 1)
