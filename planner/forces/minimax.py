"""The inner problem solved by Clarabel, one reused solver per number of fingers.

In contact frames (normal first) the cones are the same for all contacts of equal friction, so between
two solves only the D balance rows and the friction entries change and the solver is updated in place.
Moments are divided by the grasp's length and the wrench by its size: the solver sees the same numbers for
a die and for a car.
"""

import clarabel
import numpy as np
from scipy import sparse

from planner.contacts import contact_frames, grasp_maps, wrench_dimension
from planner.errors import SolverError
from planner.forces.problem import ForceProblem, ForceSolution

SOLVED = (clarabel.SolverStatus.Solved, clarabel.SolverStatus.AlmostSolved)
UNREASONABLE = 1e6
"""A direction that proves a force this many times the wrench is taken as a proof of infeasibility."""


class MinimaxForces:
    """Solver of Subproblem 2 for a fixed number of fingers.

    Variables x = (f_1, ..., f_m, phi) in contact frames, in the standard form A x + s = b, s in a product of
    cones: D balance rows (zero cone), then per finger the friction cone (mu f_n, f_t) and the cap (phi, f).
    """

    def __init__(self, fingers: int, dimension: int) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
        """
        self.fingers, self.dimension = fingers, dimension
        self._balance_rows = wrench_dimension(dimension)
        self._data, self._balance, self._friction = self._pattern()
        self._bounds = np.zeros(self._balance_rows + fingers * (2 * dimension + 1))
        self._solver: clarabel.DefaultSolver | None = None

    def solve(self, problem: ForceProblem) -> ForceSolution:
        """Solve one problem.

        Args:
            problem: With this solver's number of contacts and dimension.

        Raises:
            SolverError: When Clarabel stops without an optimum or a certificate.
        """
        contacts = problem.contacts
        frames = contact_frames(contacts.normals)
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
            maps: Grasp maps times contact frames, G_i R_i, shape (m, D, d).
            friction: Shape (m,).
            wrench: Shape (D,) [N, N m].
            length: Length that makes moments comparable with forces [m].

        Returns:
            Forces in contact frames, shape (m, d) [N]; phi [N]; direction lambda, shape (D,). Where Clarabel
            finds no solution the forces are NaN and phi is infinite; the direction tells whether that is proven.
        """
        d, rows = self.dimension, self._balance_rows
        scale = np.ones(rows)
        scale[d:] = 1 / length
        load = scale * wrench
        force = float(np.abs(load).max()) or 1.0
        self._data.data[self._balance] = (scale[:, None] * maps).transpose(0, 2, 1).ravel()
        self._data.data[self._friction] = -friction
        self._bounds[:rows] = -load / force
        solution = self._optimise()
        direction = -np.asarray(solution.z[:rows]) * scale
        if solution.status not in SOLVED:
            return np.full((self.fingers, d), np.nan), np.inf, direction
        forces = force * np.asarray(solution.x[:-1]).reshape(self.fingers, d)
        return forces, float(np.sqrt((forces * forces).sum(axis=1).max())), direction

    def _optimise(self) -> clarabel.DefaultSolution:
        if self._solver is None:
            columns = self._data.shape[1]
            objective = np.zeros(columns)
            objective[-1] = 1.0
            settings = clarabel.DefaultSettings()
            settings.verbose = False
            settings.max_threads = 1
            settings.presolve_enable = False  # presolve and decomposition would forbid updates in place
            settings.chordal_decomposition_enable = False
            settings.input_sparse_dropzeros = False
            cones = [clarabel.ZeroConeT(self._balance_rows)]
            cones += self.fingers * [
                clarabel.SecondOrderConeT(self.dimension),
                clarabel.SecondOrderConeT(self.dimension + 1),
            ]
            quadratic = sparse.csc_matrix((columns, columns))
            self._solver = clarabel.DefaultSolver(quadratic, objective, self._data, self._bounds, cones, settings)
        else:
            self._solver.update(A=self._data.data, b=self._bounds)
        return self._solver.solve()

    def _pattern(self) -> tuple[sparse.csc_matrix, np.ndarray, np.ndarray]:
        """Constraint matrix A in CSC form and the positions, in its data, of balance and friction entries."""
        d, rows = self.dimension, self._balance_rows
        dense = np.zeros((rows + self.fingers * (2 * d + 1), self.fingers * d + 1))
        dense[:rows, :-1] = np.nan  # balance entries, marked
        for finger in range(self.fingers):
            force = slice(finger * d, (finger + 1) * d)
            cone = rows + finger * (2 * d + 1)
            dense[cone : cone + d, force] = -np.eye(d)
            dense[cone, finger * d] = np.inf  # the friction entry, marked
            dense[cone + d, -1] = -1.0
            dense[cone + d + 1 : cone + 2 * d + 1, force] = -np.eye(d)
        matrix = sparse.csc_matrix(dense)
        return matrix, np.flatnonzero(np.isnan(matrix.data)), np.flatnonzero(np.isinf(matrix.data))
