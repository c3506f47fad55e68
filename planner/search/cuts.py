"""The cut table: every direction lambda bounds rho of every subset, from below, without a solver.

With h_i(lambda) the support function of G_i (K_i ∩ B) and c(lambda) = max_j -lambda . w_j > 0,

    1 / rho_N  <=  sum_{i in N} a_i(lambda),      a_i = h_i / c       [1/N].

So problem (4) is: max over subsets N of min over cuts of sum_{i in N} a_i, a table with one row per candidate and one
column per cut. Directions come from solved inner problems (their dual optimum, or the certificate of infeasibility)
but the bound holds whatever their source.
"""

import numpy as np

from planner.arrays import Floats, Indices
from planner.search.compiled.compile import compiled_capacities
from planner.search.problem import SearchProblem

FIRST_CUTS = 256
"""Columns of the table at the start; doubled when full."""


class CutTable:
    """Directions and the bound each gives to every candidate."""

    def __init__(self, problem: SearchProblem) -> None:
        self.problem = problem
        self._directions = np.empty((FIRST_CUTS, problem.wrenches.shape[1]))
        self._loads = np.empty((FIRST_CUTS, len(problem.wrenches)))
        self._values = np.empty((len(problem.contacts), FIRST_CUTS))
        self._capacities_of = compiled_capacities(problem.model)
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def directions(self) -> Floats:
        """lambda of each cut, scaled so that c(lambda) = 1, shape (cuts, D)."""
        return self._directions[: self._count]

    @property
    def values(self) -> Floats:
        """a_i(lambda_k), shape (n, cuts) [1/N]."""
        return self._values[:, : self._count]

    @property
    def loads(self) -> Floats:
        """-lambda_k . w_j, at most 1, shape (cuts, l)."""
        return self._loads[: self._count]

    def add(self, direction: Floats) -> bool:
        """Add the cut of a direction, shape (D,); returns False where c(lambda) <= 0: it bounds nothing."""
        loads = -self.problem.wrenches @ direction
        load = loads.max()
        if not np.isfinite(load) or load <= 0:
            return False
        self._grow()
        column = self._count
        self._directions[column], self._loads[column] = direction / load, loads / load
        self._values[:, column] = self._capacities(slice(None), direction / load)
        self._count += 1
        return True

    def add_if_below(self, direction: Floats, subset: Indices, bound: float) -> bool:
        """Add the cut of a direction if it bounds 1 / rho of the subset, shape (m,), below `bound` [1/N]."""
        load = (-self.problem.wrenches @ direction).max()
        if not load > 0 or not self._capacities(subset, direction).sum() < bound * load:
            return False
        return self.add(direction)

    def bound(self, subset: Indices) -> tuple[float, int]:
        """Best upper bound on 1 / rho of a subset, shape (m,) [1/N], and the cut that gives it."""
        sums = self.values[subset].sum(axis=0)
        cut = int(sums.argmin())
        return float(sums[cut]), cut

    def bounds(self, subsets: Indices) -> tuple[Floats, Indices]:
        """The same of many subsets, shape (subsets, m): their bounds and the cuts, shape (subsets,) each."""
        sums = self.values[subsets[:, 0]]
        for candidates in subsets[:, 1:].T:
            sums += self.values[candidates]
        return sums.min(axis=1), sums.argmin(axis=1)

    def dangerous_cases(self, subset: Indices) -> Indices:
        """All cases, those first that the cuts call most demanding for this subset, shape (cases,).

        Without position error a case is a vertex of W_R. With it, every vertex comes first with the shifts at which the
        sharpest cut does least.
        """
        problem, vertices = self.problem, self.dangerous_vertices(subset)
        if not problem.position_error:
            return vertices
        direction = self.directions[self.bound(subset)[1]]
        shifts = [self._of(maps[subset], problem.contacts.friction[subset], direction) for maps in problem.shifted_maps]
        shape = (len(shifts),) * problem.fingers
        first = np.ravel_multi_index(np.argmin(shifts, axis=0), shape) * len(problem.wrenches) + vertices
        return np.concatenate([first, np.setdiff1d(np.arange(problem.cases), first)])

    def dangerous_vertices(self, subset: Indices, sharpest: int = 64) -> Indices:
        """Vertices of W_R, the one the cuts call most demanding for this subset first, shape (l,).

        phi_N(w_j) >= -lambda_k . w_j / sum_{i in N} h_i(lambda_k), over the `sharpest` cuts for this subset.
        """
        sums = self.values[subset].sum(axis=0)
        loads = self.loads
        if len(sums) > sharpest:
            chosen = np.argpartition(sums, sharpest)[:sharpest]
            sums, loads = sums[chosen], loads[chosen]
        floor = np.finfo(float).tiny
        return np.argsort(-(loads / np.maximum(sums, floor)[:, None]).max(axis=0), kind="stable")

    def _capacities(self, which: Indices | slice, direction: Floats) -> Floats:
        """h_i(lambda) of some candidates; with position error the least of all shifts."""
        friction = self.problem.contacts.friction[which]
        return np.min([self._of(maps[which], friction, direction) for maps in self.problem.shifted_maps], axis=0)

    def _of(self, maps: Floats, friction: Floats, direction: Floats) -> Floats:
        values = np.empty(len(maps))
        self._capacities_of(maps, friction, direction, values)
        return values

    def _grow(self) -> None:
        if self._count == len(self._directions):
            self._directions = np.concatenate([self._directions, np.empty_like(self._directions)])
            self._loads = np.concatenate([self._loads, np.empty_like(self._loads)])
            self._values = np.concatenate([self._values, np.empty_like(self._values)], axis=1)
