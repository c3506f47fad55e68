"""Is the task possible at all? One direction that proves that no subset can resist W_R.

If even all n candidates together cannot balance some vertex, the certificate of that one infeasible problem is a
cut with a_i = 0 for every candidate: it proves every subset infeasible at once.
"""

import numpy as np

from planner.arrays import Floats
from planner.forces.minimax import MinimaxForces
from planner.search.problem import SearchProblem


def impossible_direction(problem: SearchProblem) -> Floats | None:
    """A direction lambda that all candidates together cannot push along, though W_R asks for it.

    Returns:
        lambda, shape (D,), or None if all candidates together resist every vertex of W_R.
    """
    solver = MinimaxForces(len(problem.contacts), problem.contacts.dimension, problem.model)
    for wrench in problem.wrenches:
        _, phi, direction = solver.solve_arrays(problem.maps, problem.contacts.friction, wrench, problem.length)
        if np.isinf(phi):
            return direction
    return None
