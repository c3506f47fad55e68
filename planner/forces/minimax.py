"""The inner problem, Subproblem 2, solved by Clarabel: min phi over balanced forces in their cones, |f_i| <= s_i phi.

The maps of a contact model hold the strength of each finger, so that fingers of all strengths are alike here.

Source: Watanabe and Yoshikawa, eq. (7).
"""

import clarabel
import numpy as np

from planner.arrays import Floats
from planner.contact_models.contact_model import ContactModel
from planner.contact_models.hard_finger import HARD_FINGER
from planner.errors import SolverError
from planner.forces.contact_program import SOLVED, ContactProgram, Criterion
from planner.forces.problem import ForceProblem, ForceSolution

UNREASONABLE = 1e6
"""A direction that proves a force this many times the wrench is taken as a proof of infeasibility."""


class MinimaxForces:
    """Solver of Subproblem 2 for a fixed number of fingers.

    Variables (x_1, ..., x_m, phi); the rows added to the contacts' are the caps (phi, the first d components of x_i).
    """

    def __init__(self, fingers: int, dimension: int, model: ContactModel = HARD_FINGER) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
            model: Of the contacts.
        """
        self.fingers, self.model = fingers, model
        self._dimension, components = dimension, model.components(dimension)
        variables, cap = fingers * components + 1, dimension + 1
        caps = np.zeros((fingers * cap, variables))
        for finger in range(fingers):
            caps[finger * cap, -1] = -1.0
            force = slice(finger * components, finger * components + dimension)
            caps[finger * cap + 1 : (finger + 1) * cap, force] = -np.eye(dimension)
        criterion = Criterion(
            quadratic=np.zeros((variables, variables)),
            linear=np.append(np.zeros(variables - 1), 1.0),
            rows=caps,
            cones=[clarabel.SecondOrderConeT(cap) for _ in range(fingers)],
        )
        self._program = ContactProgram(fingers, dimension, model, criterion)

    def solve(self, problem: ForceProblem) -> ForceSolution:
        """Solve one problem.

        Args:
            problem: With this solver's number of contacts and dimension.

        Raises:
            SolverError: When Clarabel stops without an optimum or a certificate.
        """
        contacts = problem.contacts
        maps = self.model.maps(contacts, problem.reference_point)
        components, phi, direction = self.solve_arrays(maps, contacts.friction, problem.wrench, problem.length)
        solution = ForceSolution(
            problem=problem,
            feasible=bool(np.isfinite(phi)),
            forces=self.model.forces(contacts, components),
            torques=self.model.torques(contacts, components),
            phi=phi,
            direction=direction,
        )
        if not solution.feasible and solution.lower_bound() < UNREASONABLE * float(np.abs(problem.wrench).max()):
            raise SolverError(f"Clarabel found neither forces nor a proof that there are none ({self.fingers} fingers)")
        return solution

    def solve_arrays(
        self, maps: Floats, friction: Floats, wrench: Floats, length: float
    ) -> tuple[Floats, float, Floats]:
        """The same on bare arrays, for callers that keep grasp maps of many contacts.

        Args:
            maps: The model's, shape (m, D, k).
            friction: Shape (m,).
            wrench: Shape (D,) [N, N m].
            length: Length that makes moments comparable with forces [m].

        Returns:
            Components over strengths, shape (m, k) [N]; phi [N]; direction lambda, shape (D,). Where Clarabel finds no
            solution the components are NaN and phi is infinite; the direction tells whether that is
            proven.
        """
        components, direction, status = self._program.solve(maps, friction, wrench, length)
        forces = components[:, : self._dimension]
        phi = float(np.sqrt((forces * forces).sum(axis=1).max())) if status in SOLVED else np.inf
        return components, phi, direction
