"""Mass properties that are allowed here and wrong almost everywhere else."""

import numpy as np
from scipy.spatial import ConvexHull

from planner.arrays import Floats
from planner.millimetres import in_mm, point_in_mm
from planner.objects.rigid_object import RigidObject

DENSITIES = (10.0, 25_000.0)
"""The lightest foam, and a little more than osmium, the densest metal [kg / m^3]."""

OUTSIDE = 0.01
"""How far outside the hull a centre of mass may be, relative to the object's size: curved parts are tessellated."""

SAMPLES = 20_000
"""Random points that estimate the volume: to 5 % where the parts fill 2 % of their bounding box."""


def mass_doubts(rigid_object: RigidObject) -> list[str]:
    """One sentence for each property that deserves a warning."""
    name, mass = rigid_object.body, rigid_object.mass
    if mass <= 0:
        return [f"body '{name}' has no mass; tasks that need its weight will refuse it, give one with --mass"]
    doubts = []
    if np.linalg.eigvalsh(rigid_object.inertia)[-1] > mass * rigid_object.size**2:
        doubts.append(
            f"the inertia of body '{name}' is too large for its mass and size; is it a placeholder? "
            "(no result depends on it; look at the centre of mass too)"
        )
    volume = union_volume(rigid_object)
    least, most = DENSITIES
    if volume > 0 and not least <= mass / volume <= most:
        doubts.append(
            f"body '{name}' weighs {mass:.3g} kg, {mass / volume:.3g} kg per m3 of the union of its collision geoms "
            f"({'lighter than foam' if mass / volume < least else 'heavier than any metal'}); give the mass with "
            "--mass if that is wrong"
        )
    outside = height_outside(rigid_object, rigid_object.center_of_mass)
    if outside > OUTSIDE * rigid_object.size:
        place = point_in_mm(rigid_object.center_of_mass)
        doubts.append(
            f"the centre of mass of body '{name}', {place} mm, is {in_mm(outside)} mm outside the convex hull of "
            "its collision geoms; is its inertial a placeholder, or in another frame? give it with --com"
        )
    return doubts


def height_outside(rigid_object: RigidObject, point: Floats) -> float:
    """Greatest height of a point, shape (3,), above a facet of the hull of all parts; zero if it lies in a part [m]."""
    if any(part.depth(point[None])[0] >= 0 for part in rigid_object.parts):
        return 0.0
    corners = np.concatenate([part.triangles()[0].reshape(-1, 3) for part in rigid_object.parts])
    facets = ConvexHull(corners).equations
    return max(0.0, float((facets[:, :3] @ point + facets[:, 3]).max()))


def union_volume(rigid_object: RigidObject) -> float:
    """Volume of the union of the parts, estimated from the same random points every time [m^3]."""
    bounds = np.array([part.bounds() for part in rigid_object.parts])
    lower, upper = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
    points = np.random.Generator(np.random.PCG64(0)).uniform(lower, upper, (SAMPLES, 3))
    inside = np.zeros(SAMPLES, dtype=bool)
    for part, (start, stop) in zip(rigid_object.parts, bounds, strict=True):
        asked = np.flatnonzero(~inside & ((points > start) & (points < stop)).all(axis=1))
        inside[asked] = part.depth(points[asked]) > 0
    return float(np.prod(upper - lower) * inside.mean())
