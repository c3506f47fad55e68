"""Exact evaluation of one subset: Subproblem 1 as Subproblem 2 over the vertices of W_R."""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Indices
from planner.forces.minimax import MinimaxForces
from planner.search.problem import SearchProblem

Solution = tuple[Floats, float, Floats]
"""Components over strengths (m, k) [N], phi [N] (infinite: none found), direction lambda (D,)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Evaluation:
    """rho of one subset with the forces that achieve it."""

    subset: Indices
    """Candidate indices, shape (m,)."""

    phi: Floats
    """phi_N(w_j), the least force level max_i |f_i| / s_i, shape (l,) [N]; infinite where no force balances w_j."""

    forces: Floats
    """Contact forces in the body frame, shape (l, m, d) [N]; NaN where infeasible."""

    torques: Floats
    """Contact torques about the inward normals, shape (l, m) [N m]; NaN where infeasible."""

    @property
    def rho(self) -> float:
        """max_j phi_N(w_j) [N]."""
        return float(self.phi.max())

    @property
    def critical_wrench(self) -> int:
        """The vertex of W_R that needs rho."""
        return int(self.phi.argmax())


class Evaluator:
    """Solves inner problems of subsets with one reused solver and counts them."""

    def __init__(self, problem: SearchProblem) -> None:
        self.problem = problem
        self.solves = 0
        self._solver = MinimaxForces(problem.fingers, problem.contacts.dimension, problem.model)

    def solve(self, subset: Indices, case: int) -> Solution:
        """Subproblem 2 for one subset, shape (m,), and one case: a vertex of W_R and a shift of each finger."""
        problem = self.problem
        self.solves += 1
        shifts, vertex = self.shifts_and_vertex(case)
        return self._solver.solve_arrays(
            problem.shifted_maps[shifts, subset],
            problem.contacts.friction[subset],
            problem.wrenches[vertex],
            problem.length,
        )

    def shifts_and_vertex(self, case: int) -> tuple[Indices, int]:
        """The shift of each finger, shape (m,), and the vertex of W_R of a case; without position error case = vertex.

        Cases count the vertices fastest, then the shifts of the last finger.
        """
        combination, vertex = divmod(case, len(self.problem.wrenches))
        shape = (len(self.problem.shifted_maps),) * self.problem.fingers
        return np.array(np.unravel_index(combination, shape)), vertex

    def evaluate(self, subset: Indices) -> Evaluation:
        """Subproblem 1: all cases at full accuracy."""
        return self.collect(subset, [self.solve(subset, case) for case in range(self.problem.cases)])

    def collect(self, subset: Indices, solutions: list[Solution]) -> Evaluation:
        """The evaluation made of one solution per case, in order; of each vertex the worst shifts count."""
        contacts = self.problem.fingertips.subset(subset)
        phi = np.array([phi for _, phi, _ in solutions]).reshape(-1, len(self.problem.wrenches))
        worst = np.stack([solutions[case][0] for case in phi.argmax(axis=0) * phi.shape[1] + np.arange(phi.shape[1])])
        return Evaluation(
            subset=subset,
            phi=phi.max(axis=0),
            forces=self.problem.model.forces(contacts, worst),
            torques=self.problem.model.torques(contacts, worst),
        )
