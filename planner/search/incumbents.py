"""The grasps found so far that are still wanted, and the force level above which none is.

    the best               level = rho_1 / (1 + gap)
    the k best             level = rho_k / (1 + gap)          rho_k: k-th smallest rho found
    all within tolerance   level = rho_1 (1 + within)

A subset that needs at least the level is not wanted, so a search that has proven this of all others is complete.
"""

from collections.abc import Callable

import numpy as np

from planner.arrays import Indices
from planner.search.evaluation import Evaluation

SOLVER_ACCURACY = 1e-6
"""Relative accuracy of rho that the inner solver guarantees: no smaller gap can be asked of a proof."""


class Incumbents:
    """Wanted grasps, best first."""

    def __init__(
        self,
        ceiling: float,
        gap: float,
        keep: int,
        within: float | None,
        admits: Callable[[Indices], bool] = lambda _: True,
    ) -> None:
        """
        Args:
            ceiling: Force above which a subset counts as infeasible [N].
            gap: Relative gap to prove.
            keep: How many grasps to keep.
            within: Keep all (up to `keep`) whose rho exceeds the best by at most this, relatively; None: no such
                limit.
            admits: Whether a subset, shape (m,), may be kept at all.
        """
        self._admits = admits
        self._ceiling, self._gap, self._keep, self._within = ceiling, gap, keep, within
        self._grasps: dict[tuple[int, ...], Evaluation] = {}

    def __contains__(self, subset: Indices) -> bool:
        return tuple(subset.tolist()) in self._grasps

    @property
    def grasps(self) -> tuple[Evaluation, ...]:
        """Best first."""
        return tuple(self._grasps.values())

    @property
    def best(self) -> Evaluation | None:
        return next(iter(self._grasps.values()), None)

    @property
    def rho(self) -> float:
        """rho of the best; infinite before the first [N]."""
        return self.best.rho if self.best else np.inf

    @property
    def level(self) -> float:
        """Subsets that need this much or more are not wanted [N]."""
        level = self._ceiling
        if len(self._grasps) >= self._keep:
            level = self.grasps[self._keep - 1].rho / (1 + self._gap)
        if self._within is not None and self.best:
            level = min(level, self.rho * (1 + max(self._within, SOLVER_ACCURACY)))
        return level

    def offer(self, evaluation: Evaluation) -> bool:
        """Keep the grasp if it is wanted, and drop those that it makes unwanted; returns whether it was kept."""
        if not self._admits(evaluation.subset):
            return False
        offered = [*self._grasps.values(), evaluation]
        offered.sort(key=lambda grasp: grasp.rho)
        kept = offered[: self._keep]
        if self._within is not None:
            most = kept[0].rho * (1 + max(self._within, SOLVER_ACCURACY))
            kept = [grasp for grasp in kept if grasp.rho <= most]
        self._grasps = {tuple(grasp.subset.tolist()): grasp for grasp in kept}
        return evaluation.subset in self
