"""Problem (4) as one mixed-integer second-order cone program, by CVXPY and SCIP (only where pyscipopt is installed).

    min phi   s.t.   sum_i G_i f_ij = -w_j  for every wrench j,   f_ij in K_i,   |f_ij| <= phi,
                     normal f_ij <= M x_i,   sum_i x_i = m,   x binary

M is rho of a grasp found at random; forces are divided by it and moments by the problem's length, so that SCIP's
tolerances mean the same for every instance.
"""

import time

import cvxpy
import numpy as np

from planner.errors import CandidateError
from planner.search.evaluation import Evaluator
from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.competitors.restarts import restart
from scripts.search_benchmark.isolated import run_isolated

SECONDS_FOR_M = 1.0
"""How long random restarts look for M."""


def solve_as_cone_program(problem: SearchProblem, gap: float, budget: float) -> Outcome:
    """Hand the whole program to SCIP and wait for the budget [s], which includes the building of the program.

    Raises:
        CandidateError: Where fingers are not hard, alike and free to be anywhere, which the program does not say.
    """
    if not problem.is_the_papers:
        raise CandidateError("this program is of hard fingers that are alike and keep no distances")
    answer = run_isolated(_solve, problem, gap, limit=budget)
    return answer.value if answer else Outcome(seconds=budget, finished=False, note="stopped")


def _solve(problem: SearchProblem, gap: float) -> Outcome:
    began = time.perf_counter()
    most = min(restart(problem, SECONDS_FOR_M, seed=0), problem.force_ceiling)
    chosen, phi, program = _program(problem, most)
    program.solve(solver=cvxpy.SCIP, scip_params={"limits/gap": gap})
    seconds = time.perf_counter() - began
    if program.status != cvxpy.OPTIMAL:
        return Outcome(seconds=seconds, finished=False, note=str(program.status))
    rho = Evaluator(problem).evaluate(np.sort(np.argsort(chosen.value)[-problem.fingers :])).rho
    return Outcome(seconds=seconds, finished=True, rho=rho, lower_bound=most * float(phi.value) / (1 + gap))


def _program(problem: SearchProblem, most: float) -> tuple[cvxpy.Variable, cvxpy.Variable, cvxpy.Problem]:
    """x, phi / M and the program; forces in contact frames, the normal component first."""
    count, size, dimension = problem.maps.shape
    scale = np.ones(size)
    scale[dimension:] /= problem.length
    balance = np.hstack(list(scale[:, None] * problem.maps))
    friction = problem.contacts.friction
    phi, chosen = cvxpy.Variable(), cvxpy.Variable(count, boolean=True)
    constraints = [cvxpy.sum(chosen) == problem.fingers]
    for wrench in problem.wrenches:
        forces = cvxpy.Variable((count, dimension))
        normal = forces[:, 0]
        constraints += [
            balance @ cvxpy.vec(forces, order="C") == -scale * wrench / most,
            cvxpy.SOC(cvxpy.multiply(friction, normal), forces[:, 1:], axis=1),
            cvxpy.SOC(phi * np.ones(count), forces, axis=1),
            normal <= chosen,
        ]
    return chosen, phi, cvxpy.Problem(cvxpy.Minimize(phi), constraints)
