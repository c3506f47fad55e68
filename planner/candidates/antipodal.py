"""Opposed pairs: points with one opposite, so that a few candidates already hold good grasps of two fingers.

Two fingers can hold an object if the line through them lies inside both friction cones, and only then: hard ones in the
plane, soft ones in space. Source: Nguyen, Constructing force-closure grasps (1988).

From a random point of the outside a ray goes inward along the normal. Wherever it leaves the object - through the near
wall of a cup, and again through the far one - the surface may oppose the point; of the places that do, and that a
fingertip reaches, one is drawn to be its partner. Of these pairs are chosen those that lie farthest from all points
chosen before, more densely where their line passes near the centre of mass: a load is most often a weight, and what it
turns about the line is left to torsional friction. Two fingers that push apart, inside a hollow, are not among them.
"""

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.candidates.candidates import Candidates, candidates_at
from planner.candidates.even import OVERSAMPLING, seeded, surface_pool
from planner.candidates.farthest import farthest_points
from planner.contacts import Contacts
from planner.errors import CandidateError
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.exposure import PROBES, reachable
from planner.objects.surface.projection import project
from planner.objects.surface.rays import crossings
from planner.objects.surface.sampling import finger_surface
from planner.objects.vectors import norm, unit

NEAR = 0.1
"""The distance between neighbouring pairs grows as this share of the object's size plus the distance of their line from
the centre of mass. Measured: of 0.05, 0.1, 0.2, 0.4 and alike everywhere, the two smallest give the smallest rho."""

MOST_ROUNDS = 8
"""Rounds of drawing before what was found has to do."""


def antipodal_candidates(
    rigid_object: RigidObject, count: int, friction: float | None, seed: int, fingertip: float | None = None
) -> Candidates:
    """Candidates in opposed pairs, the two of each one after the other.

    Args:
        rigid_object: The object.
        count: 2 to MOST_CANDIDATES, even. There are fewer where fewer of the drawn points are opposed.
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        seed: Of the random pool, not negative.
        fingertip: Radius of the ball that must fit beside other parts [m]; by default a share of the object's size.

    Raises:
        CandidateError: If an argument is out of range, nearly all of the surface is inside other parts, or no two
            points oppose each other.
    """
    generator = seeded(count, seed)
    if count % 2:
        raise CandidateError(f"{count} candidates in opposed pairs; choose an even number, {count + 1} for example")
    wanted = OVERSAMPLING * count // 2
    firsts, seconds, drawn = [], [], 0
    for _ in range(MOST_ROUNDS):
        points, part, facet = surface_pool(rigid_object, wanted, generator, fingertip)
        one = candidates_at(rigid_object, points, part, facet, friction)
        paired, other = _partners(rigid_object, one, friction, generator, fingertip)
        firsts.append(one.subset(paired))
        seconds.append(other)
        drawn += len(one)
        if sum(map(len, seconds)) >= wanted:
            break
    points, part, facet = (np.stack(ends, axis=1) for ends in zip(_joined(firsts), _joined(seconds), strict=True))
    if not len(points):
        raise CandidateError(
            f"no two places oppose each other within their friction cones, of {drawn} that were tried: two fingers "
            "slip off wherever they press; more --friction would help, or more fingers"
        )
    line = unit(points[:, 1] - points[:, 0])
    lever = norm(np.cross(rigid_object.center_of_mass - points[:, 0], line))
    spacing = NEAR * rigid_object.size + lever
    chosen = farthest_points(points[:, 0], min(count // 2, len(points)), points[:, 1], spacing)
    points, part, facet = points[chosen].reshape(-1, 3), part[chosen].ravel(), facet[chosen].ravel()
    return candidates_at(rigid_object, points, part, facet, friction)


def _joined(found: list[Candidates]) -> tuple[Floats, Indices, Indices]:
    """Points, parts and facets of several sets of candidates, one after another."""
    return (
        np.concatenate([each.contacts.points for each in found]),
        np.concatenate([each.part for each in found]),
        np.concatenate([each.facet for each in found]),
    )


def _partners(
    rigid_object: RigidObject,
    one: Candidates,
    friction: float | None,
    generator: np.random.Generator,
    fingertip: float | None,
) -> tuple[Indices, Candidates]:
    """Which candidates have an opposite, and one opposite of each."""
    triangles, part, facet = finger_surface(rigid_object)
    origins, inward = one.contacts.points, one.contacts.normals
    ray, triangle, distance = crossings(triangles, origins, inward)
    crossing = origins[ray] + distance[:, None] * inward[ray]
    points, normals = project(rigid_object, crossing, part[triangle], facet[triangle])
    ahead = ((points - origins[ray]) * inward[ray]).sum(axis=1) > PROBES[0] * rigid_object.size
    kept = np.flatnonzero(ahead & ((normals * inward[ray]).sum(axis=1) < 0))
    kept = kept[reachable(rigid_object, points[kept], normals[kept], part[triangle[kept]], fingertip)]
    other = candidates_at(rigid_object, points[kept], part[triangle[kept]], facet[triangle[kept]], friction)
    opposed = np.flatnonzero(_oppose(one.contacts.subset(ray[kept]), other.contacts))
    opposed = generator.permutation(opposed)
    paired, drawn = np.unique(ray[kept[opposed]], return_index=True)
    return paired, other.subset(opposed[drawn])


def _oppose(one: Contacts, other: Contacts) -> Mask:
    """Whether the line from each contact to its opposite lies inside both friction cones, shape (n,)."""
    line = unit(other.points - one.points)
    return _inside_cone(line, one) & _inside_cone(-line, other)


def _inside_cone(directions: Floats, contacts: Contacts) -> Mask:
    """Whether each direction, a unit vector, is one in which its contact can push, shape (n,)."""
    along = (directions * contacts.normals).sum(axis=1)
    return norm(directions - along[:, None] * contacts.normals) < contacts.friction * along
