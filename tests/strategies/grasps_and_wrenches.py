"""Random grasps with a wrench that they can resist."""

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts, grasp_maps
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem

ORIGIN = np.zeros(3)


def grasp_and_wrench(seed: int) -> tuple[Contacts, Floats, float]:
    """A random grasp, a wrench that it can balance, and the cap phi that this needs."""
    rng = np.random.default_rng(seed)
    fingers = int(rng.integers(3, 7))
    points = rng.normal(size=(fingers, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    contacts = Contacts(points=points, normals=-points, friction=rng.uniform(0.2, 1.0, size=fingers))
    pushes = contacts.normals * rng.uniform(0.1, 1, size=(fingers, 1)) + 0.08 * rng.normal(size=(fingers, 3))
    wrench = -np.einsum("iDd,id->D", grasp_maps(points, ORIGIN), pushes)
    problem = ForceProblem(contacts=contacts, reference_point=ORIGIN, wrench=wrench)
    return contacts, wrench, MinimaxForces(fingers, 3).solve(problem).phi
