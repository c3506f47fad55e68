"""What part of the collision surface a finger can reach, from random points on all parts."""

from typing import NamedTuple

import numpy as np

from planner.objects.rigid_object import RigidObject
from planner.objects.surface.coincident import parts_through
from planner.objects.surface.exposure import exposed, reachable
from planner.objects.surface.projection import project
from planner.objects.surface.sampling import areas, random_points, whole_surface

SAMPLES = 20_000
"""Random points: shares come out to half a percent."""


FACE = 3
"""Points that two parts must share before it is a face: a seam is thinner than that."""


class SurfaceSurvey(NamedTuple):
    """Areas in m^2; curved parts count with the area of their tessellation, 1 % too small at most."""

    whole: float
    """Area of all parts, hidden or not, but those that others hold."""

    outer: float
    """Area of the outside of their union."""

    reachable: float
    """Area of the outside where a fingertip fits beside other parts' walls, of the parts that fingers may touch."""

    samples: int
    """Random points asked."""

    unreachable_samples: int
    """How many of them no fingertip reaches."""

    shared: tuple[tuple[int, int], ...]
    """Pairs of parts that share a face of the outside, as coplanar boxes that overlap do."""


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
    through = parts_through(rigid_object, points) & np.isin(np.arange(len(rigid_object.parts)), part)
    whole = float(areas(triangles).sum())
    shares = 1 / np.maximum(through.sum(axis=1), 1)  # coplanar faces count once
    together = np.triu(through[outside].T.astype(int) @ through[outside], k=1)
    return SurfaceSurvey(
        whole=whole,
        outer=whole * float((outside * shares).mean()),
        reachable=whole * float((reached * shares).mean()),
        samples=SAMPLES,
        unreachable_samples=int((~reached).sum()),
        shared=tuple((int(first), int(second)) for first, second in np.argwhere(together >= FACE)),
    )
