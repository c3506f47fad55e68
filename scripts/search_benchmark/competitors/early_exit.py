"""Evaluate a subset with the planner's inner solver, and leave it as soon as one wrench asks too much."""

import numpy as np

from planner.arrays import Indices
from planner.search.evaluation import Evaluator
from planner.search.problem import SearchProblem


class EarlyExit:
    """What every competitor without cuts uses: no wrench is solved that cannot matter."""

    def __init__(self, problem: SearchProblem) -> None:
        self._evaluator = Evaluator(problem)
        self._order = list(range(len(problem.wrenches)))

    @property
    def solves(self) -> int:
        """Inner problems solved so far."""
        return self._evaluator.solves

    def rho_below(self, subset: Indices, level: float) -> float:
        """rho_N where it is below the level, else infinity.

        The wrench that exceeded the level last is tried first: it is likely to do so again.

        Args:
            subset: Candidate indices, shape (m,).
            level: [N]
        """
        rho = 0.0
        for place, vertex in enumerate(self._order):
            phi = self._evaluator.solve(subset, vertex)[1]
            if not phi < level:
                self._order.insert(0, self._order.pop(place))
                return np.inf
            rho = max(rho, phi)
        return rho
