"""A given number of candidates spread evenly over the outer surface.

Points are drawn at random with equal density per area, those inside other parts dropped, and the wanted number
chosen from the rest by farthest-point sampling. The generator is seeded (PCG64) and the arithmetic elementwise
over facets in an order fixed by geometry, so the same candidates come out on every platform.
"""

import numpy as np

from planner.arrays import Floats, Indices
from planner.candidates.candidates import Candidates, candidates_at
from planner.candidates.farthest import farthest_points
from planner.errors import CandidateError
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.exposure import reachable
from planner.objects.surface.projection import project
from planner.objects.surface.sampling import finger_surface, random_points

MOST_CANDIDATES = 1_000_000

OVERSAMPLING = 8
"""Exposed random points per candidate."""

MOST_ROUNDS = 50
"""Rounds of drawing before the surface is held to be buried."""


def even_candidates(
    rigid_object: RigidObject, count: int, friction: float | None, seed: int, fingertip: float | None = None
) -> Candidates:
    """Exactly `count` candidates, evenly spread.

    Args:
        rigid_object: The object.
        count: 1 to MOST_CANDIDATES.
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        seed: Of the random pool, not negative.
        fingertip: Radius of the ball that must fit beside other parts [m]; by default a share of the object's size.

    Raises:
        CandidateError: If an argument is out of range, or nearly all of the surface is inside other parts.
    """
    generator = seeded(count, seed)
    points, part, facet = surface_pool(rigid_object, OVERSAMPLING * count, generator, fingertip)
    chosen = farthest_points(points, count)
    return candidates_at(rigid_object, points[chosen], part[chosen], facet[chosen], friction)


def seeded(count: int, seed: int) -> np.random.Generator:
    """The generator of a random choice of `count` candidates.

    Raises:
        CandidateError: If an argument is out of range.
    """
    if not 1 <= count <= MOST_CANDIDATES:
        raise CandidateError(f"{count} candidates were asked for; choose 1 to {MOST_CANDIDATES}")
    if seed < 0:
        raise CandidateError(f"the seed is {seed}; it must not be negative")
    return np.random.Generator(np.random.PCG64(seed))


def surface_pool(
    rigid_object: RigidObject, size: int, generator: np.random.Generator, fingertip: float | None
) -> tuple[Floats, Indices, Indices]:
    """At least `size` random points that a fingertip reaches, with their parts and facets.

    Raises:
        CandidateError: If nearly all of the surface is inside other parts.
    """
    triangles, part_of, facet_of = finger_surface(rigid_object)
    points, parts, facets, found = [], [], [], 0
    for _ in range(MOST_ROUNDS):
        drawn, index = random_points(triangles, size, generator)
        drawn, normals = project(rigid_object, drawn, part_of[index], facet_of[index])
        outside = reachable(rigid_object, drawn, normals, part_of[index], fingertip)
        points.append(drawn[outside])
        parts.append(part_of[index][outside])
        facets.append(facet_of[index][outside])
        found += int(outside.sum())
        if found >= size:
            return np.concatenate(points), np.concatenate(parts), np.concatenate(facets)
    raise CandidateError(
        f"only {found} of {MOST_ROUNDS * size} random surface points leave room for a fingertip outside the "
        "other parts of the object; choose a smaller --fingertip, or remove parts that hide each other"
    )
