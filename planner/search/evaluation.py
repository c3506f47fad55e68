"""Exact evaluation of one subset: Subproblem 1 as Subproblem 2 over the vertices of W_R."""

from dataclasses import dataclass

import numpy as np

from planner.forces.minimax import MinimaxForces
from planner.search.problem import SearchProblem

Solution = tuple[np.ndarray, float, np.ndarray]
"""Forces in contact frames (m, d) [N], phi [N] (infinite: none found), direction lambda (D,)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Evaluation:
    """rho of one subset with the forces that achieve it."""

    subset: np.ndarray
    """Candidate indices, shape (m,)."""

    phi: np.ndarray
    """phi_N(w_j), shape (l,) [N]; infinite where no force balances w_j."""

    forces: np.ndarray
    """Contact forces in the body frame, shape (l, m, d) [N]; NaN where infeasible."""

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
        self._solver = MinimaxForces(problem.fingers, problem.contacts.dimension)

    def solve(self, subset: np.ndarray, vertex: int) -> Solution:
        """Subproblem 2 for one subset, shape (m,), and one vertex of W_R."""
        problem = self.problem
        self.solves += 1
        return self._solver.solve_arrays(
            problem.maps[subset], problem.contacts.friction[subset], problem.wrenches[vertex], problem.length
        )

    def evaluate(self, subset: np.ndarray) -> Evaluation:
        """Subproblem 1: all vertices at full accuracy."""
        return self.collect(subset, [self.solve(subset, vertex) for vertex in range(len(self.problem.wrenches))])

    def collect(self, subset: np.ndarray, solutions: list[Solution]) -> Evaluation:
        """The evaluation made of one solution per vertex, in order."""
        frames = self.problem.frames[subset]
        return Evaluation(
            subset=subset,
            phi=np.array([phi for _, phi, _ in solutions]),
            forces=np.stack([np.einsum("ide,ie->id", frames, forces) for forces, _, _ in solutions]),
        )
