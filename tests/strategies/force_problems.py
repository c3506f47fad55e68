"""Random inner problems."""

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from planner.arrays import Floats
from planner.contacts import Contacts, grasp_maps, wrench_dimension
from planner.forces.problem import ForceProblem

SHAPES = [(fingers, dimension) for dimension in (2, 3) for fingers in (2, 3, 4, 5)]


SEEDS = st.integers(0, 2**32 - 1)


def random_problem(rng: np.random.Generator, fingers: int, dimension: int, *, feasible: bool) -> ForceProblem:
    """A wrench made by forces inside the cones (so it can be balanced), or any wrench at all."""
    contacts = random_contacts(rng, fingers, dimension)
    radius = float(np.linalg.norm(contacts.points[0]))
    point = 0.2 * radius * rng.normal(size=dimension)
    if feasible:
        forces = cone_forces(rng, contacts)
        wrench = -np.einsum("iDd,id->D", grasp_maps(contacts.points, point), forces)
    else:
        wrench = rng.normal(size=wrench_dimension(dimension))
        wrench[dimension:] *= radius
    return ForceProblem(contacts=contacts, reference_point=point, wrench=10.0 ** rng.uniform(-4, 4) * wrench)


def random_contacts(rng: np.random.Generator, fingers: int, dimension: int) -> Contacts:
    """Contacts around a ball of a random size, their normals up to some 45 degrees off the centre."""
    outward = rng.normal(size=(fingers, dimension))
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    normals = 0.4 * rng.normal(size=(fingers, dimension)) - outward
    return Contacts(
        points=10.0 ** rng.uniform(-4, 2) * outward,
        normals=normals / np.linalg.norm(normals, axis=1, keepdims=True),
        friction=rng.uniform(0.1, 1.2, size=fingers),
    )


def cone_forces(rng: np.random.Generator, contacts: Contacts) -> Floats:
    """One force inside each friction cone: the normal plus a tangent shorter than mu."""
    tangents = rng.normal(size=contacts.points.shape)
    tangents -= (tangents * contacts.normals).sum(axis=1, keepdims=True) * contacts.normals
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    slopes = contacts.friction * rng.uniform(0, 1, size=len(contacts))
    return rng.uniform(0, 1, size=(len(contacts), 1)) * (contacts.normals + slopes[:, None] * tangents)


def soft(contacts: Contacts, torsion: float | Floats) -> Contacts:
    """The contacts with torsional friction [m], one for all or one for each."""
    return replace(contacts, torsion=np.broadcast_to(np.asarray(torsion, dtype=float), contacts.friction.shape))


def soft_problem(rng: np.random.Generator, fingers: int, *, feasible: bool) -> ForceProblem:
    """The same with torsional friction of a thousandth to the tenfold of the object's size, and none here and there.

    The wrench of a feasible one is also made by torques within the cones that forces leave room for.
    """
    hard = random_problem(rng, fingers, 3, feasible=feasible)
    contacts, size = hard.contacts, float(np.linalg.norm(hard.contacts.points[0]))
    torsion = np.where(rng.random(fingers) < 0.25, 0.0, size * 10.0 ** rng.uniform(-3, 1, fingers))
    torsion[rng.integers(fingers)] = size * 10.0 ** rng.uniform(-3, 0)
    wrench = hard.wrench.copy()
    if feasible:
        forces = cone_forces(rng, contacts)
        normal = (forces * contacts.normals).sum(axis=1)
        rubbing = np.linalg.norm(forces - normal[:, None] * contacts.normals, axis=1)
        room = np.sqrt(np.maximum(normal**2 - (rubbing / contacts.friction) ** 2, 0)) * torsion
        wrench = -np.einsum("iDd,id->D", grasp_maps(contacts.points, hard.reference_point), forces)
        wrench[3:] -= (rng.uniform(-1, 1, fingers) * room) @ contacts.normals
    return replace(hard, contacts=soft(contacts, torsion), wrench=wrench)
