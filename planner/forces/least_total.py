"""The paper's tie-break between optimal combinations: the least total of the contact forces.

    max over w in W_R of   min sqrt(sum_i f_i . f_i)   s.t.   sum_i G_i f_i = -w,   f_i in K_i

The forces satisfy balance (2) and friction (3) only: the paper puts no cap on them, so the largest may exceed rho.
The inner minimum is convex in w, so its maximum over W_R is at a vertex; its square is a quadratic program over the
friction cones. Source: Watanabe and Yoshikawa, section 4.
"""

from dataclasses import replace

import numpy as np

from planner.arrays import Floats
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contacts import Contacts
from planner.errors import ContactError, SolverError
from planner.forces.contact_program import INFEASIBLE, SOLVED, ContactProgram, Criterion
from planner.forces.problem import ForceProblem


class LeastTotalForces:
    """Solver of min sum_i f_i . f_i for a fixed number of fingers."""

    def __init__(self, fingers: int, dimension: int) -> None:
        """
        Args:
            fingers: Number of contacts m, hard ones as in the paper.
            dimension: d, 2 or 3.
        """
        variables = fingers * dimension
        criterion = Criterion(
            quadratic=np.eye(variables),
            linear=np.zeros(variables),
            rows=np.empty((0, variables)),
            cones=[],
        )
        self._program = ContactProgram(fingers, dimension, HARD_FINGER, criterion)

    def solve(self, problem: ForceProblem) -> tuple[Floats, float]:
        """Forces of least total that balance one wrench.

        Args:
            problem: With this solver's number of contacts and dimension.

        Returns:
            Contact forces in the body frame, shape (contacts, d) [N]; sqrt(sum_i f_i . f_i) [N]. NaN and infinite
            where no forces balance the wrench.

        Raises:
            ContactError: When a finger has torsional friction.
            SolverError: When Clarabel stops without an optimum or a certificate.
        """
        contacts = problem.contacts
        if contacts.torsions.any():
            raise ContactError(
                "the fingers have torsional friction; the paper's tie-break sums the forces of hard ones, and says not "
                "how torques count beside them"
            )
        alike = replace(contacts, strength=None)  # no cap: how strong a finger is does not matter
        maps = HARD_FINGER.maps(alike, problem.reference_point)
        forces, _, status = self._program.solve(maps, contacts.friction, problem.wrench, problem.length)
        if status not in SOLVED + INFEASIBLE:
            raise SolverError(
                f"Clarabel stopped with status {status} on the least total force of {len(contacts)} fingers, neither "
                "an optimum nor a proof that there is none; the grasp balances this wrench barely or barely not"
            )
        total = float(np.linalg.norm(forces)) if status in SOLVED else np.inf
        return HARD_FINGER.forces(alike, forces), total


def largest_least_total(contacts: Contacts, reference_point: Floats, wrenches: Floats) -> float:
    """The tie-break criterion of one combination: of two with the same rho, the paper prefers the smaller value.

    Args:
        contacts: The combination.
        reference_point: p_o, shape (d,) [m].
        wrenches: Vertices of W_R, shape (l, D) [N, N m].

    Returns:
        max_j min sqrt(sum_i f_i . f_i) [N]; infinite where some vertex cannot be balanced.

    Raises:
        ContactError: When a finger has torsional friction.
        SolverError: When Clarabel stops without an optimum or a certificate.
    """
    solver = LeastTotalForces(len(contacts), contacts.dimension)
    problems = (ForceProblem(contacts=contacts, reference_point=reference_point, wrench=wrench) for wrench in wrenches)
    return max(solver.solve(problem)[1] for problem in problems)
