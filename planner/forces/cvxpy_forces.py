"""Subproblem 2 in CVXPY, whatever its inequalities are written as: slow, and independent of the fast solver.

    min phi   s.t.   sum_i G_i f_i + (0, tau_i n_i) = -w,   (f_i, tau_i) in K_i,   |f_i| <= s_i phi

tau_i is zero where finger i has no torsional friction gamma_i; else it is written tau'_i gamma_i / mu_i, and its cone
|(T_i f_i, tau'_i)| <= mu_i n_i . f_i. Everything is in the body frame. Moments are divided by the problem's length and
the wrench by its size, so that the solver's tolerances are relative. Source: Watanabe and Yoshikawa, eq. (2), (3), (7).
"""

import warnings
from abc import ABC, abstractmethod
from typing import Any

import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension, wrench_scale
from planner.errors import SolverError
from planner.forces.problem import ForceProblem, ForceSolution


class CvxpyForces(ABC):
    """Solver of Subproblem 2 for a fixed number of fingers, compiled once by CVXPY (a DPP problem)."""

    def __init__(self, fingers: int, dimension: int, twisting: bool = False) -> None:
        """
        Args:
            fingers: Number of contacts m.
            dimension: d, 2 or 3.
            twisting: Whether some finger has torsional friction.
        """
        import cvxpy as cp  # here: it costs a second that only references and tests need to pay

        rows = wrench_dimension(dimension)
        example = self.tangent_map(np.eye(dimension)[0])
        self._maps = [cp.Parameter((rows, dimension)) for _ in range(fingers)]
        self._tangents = [cp.Parameter(example.shape) for _ in range(fingers)]
        self._slopes = [cp.Parameter(dimension) for _ in range(fingers)]  # mu n
        self._strengths = [cp.Parameter(nonneg=True) for _ in range(fingers)]
        self._wrench = cp.Parameter(rows)
        self._forces = [cp.Variable(dimension) for _ in range(fingers)]
        self._axes = [cp.Parameter((rows, 1)) for _ in range(fingers)] if twisting else []  # (0, n) gamma / mu
        self._turns = [cp.Variable(1) for _ in self._axes]  # tau'
        phi = cp.Variable()
        total = sum(grasp_map @ force for grasp_map, force in zip(self._maps, self._forces, strict=True))
        total += sum(axis @ turn for axis, turn in zip(self._axes, self._turns, strict=True))
        rubbing = [tangents @ force for tangents, force in zip(self._tangents, self._forces, strict=True)]
        if twisting:
            rubbing = [cp.hstack(parts) for parts in zip(rubbing, self._turns, strict=True)]
        self._balance = total == -self._wrench
        inequalities = [
            inequality
            for force, slope, tangential, strength in zip(
                self._forces, self._slopes, rubbing, self._strengths, strict=True
            )
            for inequality in self.inequalities(strength * phi, force, slope @ force, tangential)
        ]
        self._problem: Any = cp.Problem(cp.Minimize(phi), [self._balance, *inequalities])
        self._solver_error: type[Exception] = cp.SolverError

    @abstractmethod
    def tangent_map(self, normal: Floats) -> Floats:
        """T with |T f| the tangential force at a contact of this normal, shape (k, d)."""

    @abstractmethod
    def inequalities(self, cap: Any, force: Any, limit: Any, tangential: Any) -> list[Any]:
        """CVXPY constraints that say |force| <= cap and |tangential| <= limit of one finger.

        Args:
            cap: s_i phi.
            force: f_i in the body frame, shape (d,).
            limit: mu_i n_i . f_i.
            tangential: T_i f_i, then tau'_i where fingers can twist; a vector.
        """

    def solve(self, problem: ForceProblem) -> ForceSolution:
        """Solve one problem.

        Args:
            problem: With this solver's number of contacts and dimension; without torsional friction unless it twists.

        Raises:
            SolverError: When CVXPY returns neither an optimum nor a proof that there is none.
        """
        contacts = problem.contacts
        scale = wrench_scale(contacts.dimension, problem.length)
        load = scale * problem.wrench
        unit = float(np.linalg.norm(load)) or 1.0  # [N]
        self._wrench.value = load / unit
        arms = contacts.points - problem.reference_point
        for finger, normal in enumerate(contacts.normals):
            self._maps[finger].value = scale[:, None] * _wrench_map(arms[finger])
            self._tangents[finger].value = self.tangent_map(normal)
            self._slopes[finger].value = contacts.friction[finger] * normal
            self._strengths[finger].value = contacts.strengths[finger]
        levers = contacts.torsions / contacts.friction
        for axis, normal, lever in zip(self._axes, contacts.normals, levers, strict=False):
            axis.value = np.append(np.zeros(3), scale[3:] * lever * normal)[:, None]
        feasible = self._optimise()
        forces, torques = np.full(contacts.points.shape, np.nan), np.full(len(contacts), np.nan)
        if feasible:
            forces = unit * np.array([force.value for force in self._forces])
            torques = unit * levers * np.array([turn.value[0] for turn in self._turns] or 0.0)
        return ForceSolution(
            problem=problem,
            feasible=feasible,
            forces=forces,
            torques=torques,
            phi=float((np.linalg.norm(forces, axis=1) / contacts.strengths).max()) if feasible else np.inf,
            direction=-scale * np.asarray(self._balance.dual_value, dtype=float),
        )

    def _optimise(self) -> bool:
        """Whether the problem with the present parameters has a solution."""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # an inaccurate solution shows in the status
                self._problem.solve(solver="CLARABEL")
        except self._solver_error as error:
            raise SolverError(f"CVXPY failed on a force problem of {len(self._forces)} fingers: {error}") from error
        status = str(self._problem.status)
        if status not in ("optimal", "optimal_inaccurate", "infeasible", "infeasible_inaccurate"):
            raise SolverError(f"CVXPY stopped with status {status!r} on a force problem of {len(self._forces)} fingers")
        return status.startswith("optimal")


def _wrench_map(arm: Floats) -> Floats:
    """(I; [r]x): a force f at the arm r is the wrench (f, r x f), shape (D, d); derived here, not as the search does.

    Column k is the wrench of the unit force along axis k.
    """
    axes = np.eye(len(arm))
    moments = arm[0] * axes[:, 1] - arm[1] * axes[:, 0] if len(arm) == 2 else np.cross(arm, axes).T
    return np.vstack([axes, moments])
