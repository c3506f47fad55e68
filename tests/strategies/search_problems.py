"""Random small instances of problem (4) on which every search can be compared with enumeration."""

import numpy as np

from planner.contacts import Contacts, wrench_dimension
from planner.search.problem import SearchProblem


def random_problem(seed: int) -> SearchProblem:
    """Contacts on a random ellipse or ellipsoid, 2 to 4 fingers, and a random W_R; some are infeasible."""
    generator = np.random.default_rng(seed)
    dimension = int(generator.integers(2, 4))
    fingers = int(generator.integers(2, 5))
    count = int(generator.integers(fingers, {2: 16, 3: 12, 4: 9}[fingers]))
    axes = generator.uniform(0.5, 2.0, dimension)
    sphere = generator.normal(size=(count, dimension))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    normals = -sphere / axes
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    size = wrench_dimension(dimension)
    if generator.random() < 0.5:  # the origin inside: force closure is asked for
        corners = generator.normal(size=(size + 2, size))
        wrenches = corners - corners.mean(axis=0)
    else:
        wrenches = generator.normal(size=(int(generator.integers(1, 4)), size))
    scale = 10.0 ** generator.uniform(-2, 2)
    return SearchProblem(
        contacts=Contacts(points=scale * sphere * axes, normals=normals, friction=generator.uniform(0.1, 1.5, count)),
        fingers=fingers,
        reference_point=scale * generator.normal(size=dimension) * 0.1,
        wrenches=wrenches * np.r_[np.ones(dimension), np.full(size - dimension, scale)],
    )
