"""The paper's Relaxed Problem: a linear program whose optimum bounds Subproblem 2 from below.

    min phi   s.t.   |e_k . V_i u_i| <= phi  (k = 1..d),   sum_i G_i V_i u_i = -w,   u_i >= 0

The columns of V_i are the edges of an L-sided cone circumscribed about the friction cone, and the box
|f|_inf <= phi circumscribes the ball |f| <= phi, so every force of Subproblem 2 is allowed here. In the plane the
cone has two edges and is exact. Solved by HiGHS. Source: Watanabe and Yoshikawa, eq. (9) and Fig. 1.
"""

import highspy
import numpy as np
from scipy import sparse

from planner.contacts import contact_frames, wrench_dimension

SIDES = 16
"""L of the paper's examples."""


def cone_edges(normals: np.ndarray, friction: np.ndarray, sides: int = SIDES) -> np.ndarray:
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


class RelaxedForces:
    """Solver of the Relaxed Problem for a fixed number of fingers; the same HiGHS model is filled anew each time."""

    def __init__(self, fingers: int, dimension: int, sides: int = SIDES) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
            sides: L, as given to `cone_edges`.
        """
        self._dimension = dimension
        self._rows = wrench_dimension(dimension)
        edges = 2 if dimension == 2 else sides
        columns, norm_rows = fingers * edges + 1, fingers * dimension
        pattern = np.zeros((self._rows + 2 * norm_rows, columns))
        pattern[: self._rows, :-1] = 1.0
        for finger in range(fingers):
            force = slice(self._rows + finger * dimension, self._rows + (finger + 1) * dimension)
            pattern[force, finger * edges : (finger + 1) * edges] = 1.0
        pattern[self._rows + norm_rows :, :-1] = pattern[self._rows : self._rows + norm_rows, :-1]
        pattern[self._rows :, -1] = 1.0
        matrix = sparse.csc_matrix(pattern)
        self._model = highspy.HighsLp()
        self._model.num_col_, self._model.num_row_ = columns, len(pattern)
        self._model.col_cost_ = np.append(np.zeros(columns - 1), 1.0)
        self._model.col_lower_ = np.zeros(columns)
        self._model.col_upper_ = np.full(columns, highspy.kHighsInf)
        self._model.a_matrix_.format_ = highspy.MatrixFormat.kColwise
        self._model.a_matrix_.start_, self._model.a_matrix_.index_ = matrix.indptr, matrix.indices
        self._norm_rows = norm_rows
        self._solver = highspy.Highs()
        for option, value in (("output_flag", False), ("threads", 1), ("presolve", "off")):
            self._solver.setOptionValue(option, value)

    def solve_arrays(self, maps: np.ndarray, edges: np.ndarray, wrench: np.ndarray, length: float) -> float:
        """phi of the Relaxed Problem [N]; infinite where it has no solution.

        Args:
            maps: Grasp maps G_i, shape (m, D, d).
            edges: V_i, shape (m, d, L).
            wrench: w, shape (D,) [N, N m].
            length: Length that makes moments comparable with forces [m].
        """
        scale = np.ones(self._rows)
        scale[self._dimension :] = 1 / length
        load = scale * wrench
        force = float(np.abs(load).max()) or 1.0
        balance = scale[:, None] * (maps @ edges)  # (m, D, L)
        columns = np.concatenate([balance, edges, -edges], axis=1).transpose(0, 2, 1).ravel()
        self._model.a_matrix_.value_ = np.concatenate([columns, np.full(2 * self._norm_rows, -1.0)])
        unbounded = np.full(2 * self._norm_rows, -highspy.kHighsInf)
        self._model.row_lower_ = np.concatenate([-load / force, unbounded])
        self._model.row_upper_ = np.concatenate([-load / force, np.zeros(2 * self._norm_rows)])
        self._solver.passModel(self._model)
        self._solver.run()
        status = self._solver.getModelStatus()
        if status == highspy.HighsModelStatus.kInfeasible:
            return np.inf
        if status != highspy.HighsModelStatus.kOptimal:
            return 0.0  # no answer is no bound
        return force * float(self._solver.getInfo().objective_function_value)
