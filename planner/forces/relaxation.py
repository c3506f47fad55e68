"""The paper's Relaxed Problem: a linear program whose optimum bounds Subproblem 2 from below.

    min phi   s.t.   |e_k . V_i u_i| <= phi  (k = 1..d),   sum_i G_i V_i u_i = -w,   u_i >= 0

The columns of V_i are the edges of an L-sided cone circumscribed about the friction cone, and the box
|f|_inf <= phi circumscribes the ball |f| <= phi, so every force of Subproblem 2 is allowed here. In the plane the
cone has two edges and is exact; the box is not. Source: Watanabe and Yoshikawa, eq. (9) and Fig. 1.

HiGHS solves it divided by phi: how large a part of the wrench do forces in the unit box balance?

    1 / phi = max part   s.t.   -1 <= e_k . V_i u_i <= 1,   sum_i G_i V_i u_i + part w = 0,   u_i, part >= 0

No force and no wrench is a vertex to start from, so the primal simplex method has no first phase, and an infeasible
problem is one whose part is zero. This takes half the time of the program as printed.
"""

import highspy
import numpy as np
from scipy import sparse

from planner.arrays import Floats
from planner.contacts import contact_frames, wrench_dimension
from planner.forces.quiet_highs import QuietHighs

SIDES = 16
"""L of the paper's examples."""
SMALLEST_PART = 1e-7
"""A part of the wrench below HiGHS's tolerances is none: no force balances the wrench."""
MOST_ITERATIONS = 10_000
"""Bound on the simplex method, which takes six iterations on average and twenty at most for three fingers."""
OPTIONS = {
    "threads": 1,
    "presolve": "off",
    "simplex_strategy": 4,  # primal
    "simplex_scale_strategy": 0,  # the program is scaled already
    "primal_simplex_bound_perturbation_multiplier": 0.0,  # or a second solve has to undo it
    "simplex_iteration_limit": MOST_ITERATIONS,
}


def cone_edges(normals: Floats, friction: Floats, sides: int = SIDES) -> Floats:
    """V_i: unit edges of the polyhedral cone circumscribed about each friction cone.

    The cone's cross-section at unit height is a regular L-gon whose flats touch the circle of radius mu.

    Args:
        normals: Inward unit normals, shape (n, d).
        friction: Shape (n,).
        sides: L, at least 3; ignored in the plane, where the two edges are exact.

    Returns:
        Shape (n, d, L), in the axes of `normals`.
    """
    if normals.shape[1] == 2:
        circle = np.array([[1.0, -1.0]])
    else:
        angles = 2 * np.pi * np.arange(sides) / sides
        circle = np.stack([np.cos(angles), np.sin(angles)]) / np.cos(np.pi / sides)
    edges = np.empty((len(normals), normals.shape[1], circle.shape[1]))
    edges[:, 0] = 1.0
    edges[:, 1:] = friction[:, None, None] * circle
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    return contact_frames(normals) @ edges


def edge_columns(maps: Floats, edges: Floats, length: float) -> Floats:
    """What a unit of force along each edge does: its wrench G_i v, moments divided by `length`, then v itself.

    Args:
        maps: Grasp maps G_i, shape (n, D, d).
        edges: V_i, shape (n, d, L).
        length: Length that makes moments comparable with forces [m].

    Returns:
        Shape (n, L, D + d).
    """
    directions = edges.transpose(0, 2, 1)
    columns = np.concatenate([directions @ maps.transpose(0, 2, 1), directions], axis=2)
    dimension, rows = maps.shape[2], maps.shape[1]
    columns[..., dimension:rows] /= length
    return columns


class RelaxedForces:
    """Solver of the Relaxed Problem for a fixed number of fingers. One per thread: HiGHS lets others run meanwhile."""

    def __init__(self, fingers: int, dimension: int, sides: int = SIDES) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
            sides: L, as given to `cone_edges`.
        """
        self._dimension, self._rows = dimension, wrench_dimension(dimension)
        edges = 2 if dimension == 2 else sides
        matrix = _pattern(fingers, dimension, edges)
        rows, columns = matrix.shape
        self._coefficients = np.empty(matrix.nnz)
        self._columns = self._coefficients[: -self._rows].reshape(fingers, edges, self._rows + dimension)
        self._wrench = self._coefficients[-self._rows :]
        box = np.append(np.zeros(self._rows), np.ones(rows - self._rows))
        self._model = (
            *(columns, rows, matrix.nnz),
            *(int(highspy.MatrixFormat.kColwise), int(highspy.ObjSense.kMaximize), 0.0),
            np.append(np.zeros(columns - 1), 1.0),
            *(np.zeros(columns), np.full(columns, highspy.kHighsInf)),
            *(-box, box),
            *(matrix.indptr.astype(np.int32), matrix.indices.astype(np.int32), self._coefficients),
            np.zeros(columns, dtype=np.int32),  # no integers
        )
        self._solver = QuietHighs()
        for option, value in OPTIONS.items():
            self._solver.setOptionValue(option, value)

    def solve_arrays(self, maps: Floats, edges: Floats, wrench: Floats, length: float) -> float:
        """phi of the Relaxed Problem [N]; infinite where it has no solution, 0 where HiGHS finds no answer.

        Args:
            maps: Grasp maps G_i, shape (m, D, d).
            edges: V_i, shape (m, d, L).
            wrench: w, shape (D,) [N, N m].
            length: Length that makes moments comparable with forces [m].
        """
        return self.solve_columns(edge_columns(maps, edges, length), wrench, length)

    def solve_columns(self, columns: Floats, wrench: Floats, length: float) -> float:
        """The same, for callers that keep the columns of many contacts: a third less time.

        Args:
            columns: `edge_columns` of the m contacts, shape (m, L, D + d).
            wrench: w, shape (D,) [N, N m].
            length: As given to `edge_columns` [m].
        """
        self._columns[:] = columns
        self._wrench[:] = wrench
        self._wrench[self._dimension :] /= length
        force = float(np.abs(self._wrench).max()) or 1.0
        self._wrench /= force
        self._solver.passModel(*self._model)
        self._solver.run()
        if self._solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            return 0.0  # no answer is no bound
        part = float(self._solver.getObjectiveValue())
        return force / part if part > SMALLEST_PART else np.inf


def _pattern(fingers: int, dimension: int, edges: int) -> sparse.csc_matrix:
    """Where the constraint matrix has entries: balance rows, then d box rows per finger; the last column is `part`."""
    rows = wrench_dimension(dimension)
    pattern = np.zeros((rows + fingers * dimension, fingers * edges + 1))
    pattern[:rows] = 1.0
    pattern[rows:, :-1] = np.kron(np.eye(fingers), np.ones((dimension, edges)))
    return sparse.csc_matrix(pattern)
