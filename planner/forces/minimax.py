"""The inner problem, Subproblem 2, solved by Clarabel: min phi over balanced forces in their cones, |f_i| <= phi.

With the strength of each finger in its grasp map, G_i s_i, the variables are f_i / s_i, and fingers of all strengths
are alike.

Source: Watanabe and Yoshikawa, eq. (7).
"""

import clarabel
import numpy as np

from planner.contacts import contact_frames, grasp_maps
from planner.errors import SolverError
from planner.forces.contact_program import SOLVED, ContactProgram
from planner.forces.problem import ForceProblem, ForceSolution

UNREASONABLE = 1e6
"""A direction that proves a force this many times the wrench is taken as a proof of infeasibility."""


class MinimaxForces:
    """Solver of Subproblem 2 for a fixed number of fingers.

    Variables x = (f_1, ..., f_m, phi) in contact frames; the rows added to the contacts' are the caps (phi, f_i).
    """

    def __init__(self, fingers: int, dimension: int) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
        """
        self.fingers, self.dimension = fingers, dimension
        variables, cap = fingers * dimension + 1, dimension + 1
        caps = np.zeros((fingers * cap, variables))
        for finger in range(fingers):
            caps[finger * cap, -1] = -1.0
            force = slice(finger * dimension, (finger + 1) * dimension)
            caps[finger * cap + 1 : (finger + 1) * cap, force] = -np.eye(dimension)
        self._program = ContactProgram(
            fingers,
            dimension,
            quadratic=np.zeros((variables, variables)),
            linear=np.append(np.zeros(variables - 1), 1.0),
            rows=caps,
            cones=[clarabel.SecondOrderConeT(cap) for _ in range(fingers)],
        )

    def solve(self, problem: ForceProblem) -> ForceSolution:
        """Solve one problem.

        Args:
            problem: With this solver's number of contacts and dimension.

        Raises:
            SolverError: When Clarabel stops without an optimum or a certificate.
        """
        contacts = problem.contacts
        frames = contact_frames(contacts.normals) * contacts.strengths[:, None, None]
        maps = grasp_maps(contacts.points, problem.reference_point) @ frames
        forces, phi, direction = self.solve_arrays(maps, contacts.friction, problem.wrench, problem.length)
        solution = ForceSolution(
            problem=problem,
            feasible=bool(np.isfinite(phi)),
            forces=np.einsum("ide,ie->id", frames, forces),
            phi=phi,
            direction=direction,
        )
        if not solution.feasible and solution.lower_bound() < UNREASONABLE * float(np.abs(problem.wrench).max()):
            raise SolverError(f"Clarabel found neither forces nor a proof that there are none ({self.fingers} fingers)")
        return solution

    def solve_arrays(
        self, maps: np.ndarray, friction: np.ndarray, wrench: np.ndarray, length: float
    ) -> tuple[np.ndarray, float, np.ndarray]:
        """The same on bare arrays, for callers that keep grasp maps of many contacts.

        Args:
            maps: Grasp maps times contact frames and strengths, G_i R_i s_i, shape (m, D, d).
            friction: Shape (m,).
            wrench: Shape (D,) [N, N m].
            length: Length that makes moments comparable with forces [m].

        Returns:
            Forces over strengths in contact frames, shape (m, d) [N]; phi [N]; direction lambda, shape (D,). Where
            Clarabel finds no solution the forces are NaN and phi is infinite; the direction tells whether that is
            proven.
        """
        forces, direction, status = self._program.solve(maps, friction, wrench, length)
        phi = float(np.sqrt((forces * forces).sum(axis=1).max())) if status in SOLVED else np.inf
        return forces, phi, direction
