"""Mass properties that are allowed here and wrong almost everywhere else."""

import numpy as np

from planner.objects.rigid_object import RigidObject

DENSITIES = (50.0, 20_000.0)
"""Foam, and a little more than gold [kg / m^3]."""

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
            f"body '{name}' weighs {mass:.3g} kg, {mass / volume:.3g} kg per m3 of its collision geoms "
            f"({'lighter than foam' if mass / volume < least else 'heavier than gold'}); give the mass with --mass "
            "if that is wrong"
        )
    return doubts


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
