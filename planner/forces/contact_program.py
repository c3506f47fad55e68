"""Forces at m contacts that balance a wrench within the friction cones, as Clarabel takes them.

Variables (x_1, ..., x_m, extras), x_i in R^k the components of contact i as its contact model scales them, normal
first; standard form A x + s = b, s in a product of cones: D balance rows (zero cone), one friction cone
(mu x_i1, x_i2, ..., x_ik) per finger, then the rows that the criterion adds. So between two solves only the balance
rows and the friction entries change, and one solver is updated in place. Moments are divided by the grasp's length
and the wrench by its size: the solver sees the same numbers for a die and for a car.
Source: Watanabe and Yoshikawa, eq. (2) and (3).
"""

from dataclasses import dataclass

import clarabel
import numpy as np
from scipy import sparse

from planner.arrays import Floats, Indices
from planner.contact_models.contact_model import ContactModel
from planner.contacts import wrench_dimension, wrench_scale

SOLVED = (clarabel.SolverStatus.Solved, clarabel.SolverStatus.AlmostSolved)
INFEASIBLE = (clarabel.SolverStatus.PrimalInfeasible, clarabel.SolverStatus.AlmostPrimalInfeasible)


@dataclass(frozen=True, eq=False, kw_only=True)
class Criterion:
    """What is minimised: x.P x / 2 + q.x, and the rows and cones that this needs beside those of the contacts."""

    quadratic: Floats
    """P, shape (variables, variables)."""

    linear: Floats
    """q, shape (variables,); the first m k variables are the components."""

    rows: Floats
    """Further rows of A, shape (rows, variables); their b is zero."""

    cones: list[object]
    """Clarabel's cones of these rows."""


class ContactProgram:
    """min x.P x / 2 + q.x over balanced forces in their cones, for a fixed number of fingers."""

    def __init__(
        self,
        fingers: int,
        dimension: int,
        model: ContactModel,
        criterion: "Criterion",
    ) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
            model: Of the contacts.
            criterion: What is minimised.
        """
        self.fingers, self.dimension = fingers, dimension
        self._components, self._balance_rows = model.components(dimension), wrench_dimension(dimension)
        self._data, self._balance, self._friction = self._pattern(criterion.rows)
        self._bounds = np.zeros(self._data.shape[0])
        self._quadratic, self._linear = sparse.csc_matrix(np.triu(criterion.quadratic)), criterion.linear
        self._cones = [
            clarabel.ZeroConeT(self._balance_rows),
            *(clarabel.SecondOrderConeT(self._components) for _ in range(fingers)),
            *criterion.cones,
        ]
        self._solver: clarabel.DefaultSolver | None = None

    def solve(
        self, maps: Floats, friction: Floats, wrench: Floats, length: float
    ) -> tuple[Floats, Floats, clarabel.SolverStatus]:
        """Solve one problem.

        Args:
            maps: G_i from components to wrenches, shape (m, D, k); see `planner.contact_models`.
            friction: Shape (m,).
            wrench: Shape (D,) [N, N m].
            length: Length that makes moments comparable with forces [m].

        Returns:
            Components, shape (m, k) [N], NaN where Clarabel finds none; the direction lambda, shape (D,), minus the
            multiplier of the balance, of any positive scale; Clarabel's status.
        """
        rows, k = self._balance_rows, self._components
        scale = wrench_scale(self.dimension, length)
        load = scale * wrench
        force = float(np.abs(load).max()) or 1.0
        self._data.data[self._balance] = (scale[:, None] * maps).transpose(0, 2, 1).ravel()
        self._data.data[self._friction] = -friction
        self._bounds[:rows] = -load / force
        solution = self._optimise()
        direction = -np.asarray(solution.z[:rows]) * scale
        if solution.status not in SOLVED:
            return np.full((self.fingers, k), np.nan), direction, solution.status
        forces = force * np.asarray(solution.x[: self.fingers * k]).reshape(self.fingers, k)
        return forces, direction, solution.status

    def _optimise(self) -> clarabel.DefaultSolution:
        if self._solver is None:
            settings = clarabel.DefaultSettings()
            settings.verbose = False
            settings.max_threads = 1
            settings.presolve_enable = False  # presolve and decomposition would forbid updates in place
            settings.chordal_decomposition_enable = False
            settings.input_sparse_dropzeros = False
            self._solver = clarabel.DefaultSolver(
                self._quadratic, self._linear, self._data, self._bounds, self._cones, settings
            )
        else:
            self._solver.update(A=self._data.data, b=self._bounds)
        return self._solver.solve()

    def _pattern(self, further: Floats) -> tuple[sparse.csc_matrix, Indices, Indices]:
        """Constraint matrix A in CSC form and the positions, in its data, of balance and friction entries."""
        rows, k = self._balance_rows, self._components
        forces = self.fingers * k
        dense = np.zeros((rows + forces, further.shape[1]))
        dense[:rows, :forces] = np.nan  # balance entries, marked
        dense[rows:, :forces] = -np.eye(forces)
        dense[range(rows, rows + forces, k), range(0, forces, k)] = np.inf  # friction entries, marked
        matrix = sparse.csc_matrix(np.vstack([dense, further]))
        return matrix, np.flatnonzero(np.isnan(matrix.data)), np.flatnonzero(np.isinf(matrix.data))
