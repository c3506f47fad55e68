"""The cut table: every direction lambda bounds rho of every subset, from below, without a solver.

With h_i(lambda) the support function of G_i (K_i ∩ B) and c(lambda) = max_j -lambda . w_j > 0,

    1 / rho_N  <=  sum_{i in N} a_i(lambda),      a_i = h_i / c       [1/N].

So problem (4) is: max over subsets N of min over cuts of sum_{i in N} a_i, a table with one row per cut and one
column per candidate. Directions come from solved inner problems (their dual optimum, or the certificate of
infeasibility) but the bound holds whatever their source.
"""

from dataclasses import dataclass

import numpy as np

from planner.contacts import grasp_maps
from planner.friction_cone import support
from planner.search.problem import SearchProblem


@dataclass(frozen=True, eq=False, kw_only=True)
class Cut:
    """One row of the table."""

    direction: np.ndarray
    """lambda, scaled so that c(lambda) = 1, shape (D,)."""

    values: np.ndarray
    """a_i(lambda), shape (n,) [1/N]."""

    loads: np.ndarray
    """-lambda . w_j, at most 1, shape (l,)."""


class CutTable:
    """Directions and the column of bounds each gives to the candidates."""

    def __init__(self, problem: SearchProblem) -> None:
        self.problem = problem
        self._grasp_maps = grasp_maps(problem.contacts.points, problem.reference_point)
        self._directions = np.empty((64, problem.wrenches.shape[1]))
        self._values = np.empty((64, len(problem.contacts)))
        self._loads = np.empty((64, len(problem.wrenches)))
        self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def directions(self) -> np.ndarray:
        """lambda of each cut, scaled so that c(lambda) = 1, shape (cuts, D)."""
        return self._directions[: self._count]

    @property
    def values(self) -> np.ndarray:
        """a_i(lambda_k), shape (cuts, n) [1/N]."""
        return self._values[: self._count]

    @property
    def loads(self) -> np.ndarray:
        """-lambda_k . w_j, at most 1, shape (cuts, l)."""
        return self._loads[: self._count]

    def evaluate(self, direction: np.ndarray) -> Cut | None:
        """The cut a direction gives, shape (D,), or None where c(lambda) <= 0: it bounds nothing."""
        loads = -self.problem.wrenches @ direction
        load = loads.max()
        if not np.isfinite(load) or load <= 0:
            return None
        contacts = self.problem.contacts
        pulls = np.einsum("iDd,D->id", self._grasp_maps, direction)
        values = support(pulls, contacts.normals, contacts.friction)
        return Cut(direction=direction / load, values=values / load, loads=loads / load)

    def add(self, cut: Cut) -> None:
        """Append a cut."""
        if self._count == len(self._directions):
            for name in ("_directions", "_values", "_loads"):
                array = getattr(self, name)
                setattr(self, name, np.concatenate([array, np.empty_like(array)]))
        row = self._count
        self._directions[row], self._values[row], self._loads[row] = cut.direction, cut.values, cut.loads
        self._count += 1

    def bound(self, subset: np.ndarray) -> tuple[float, int]:
        """Best upper bound on 1 / rho of a subset, shape (m,) [1/N], and the cut that gives it."""
        sums = self.values[:, subset].sum(axis=1)
        cut = int(sums.argmin())
        return float(sums[cut]), cut

    def dangerous_vertices(self, subset: np.ndarray, sharpest: int = 64) -> np.ndarray:
        """Vertices of W_R, the one the cuts call most demanding for this subset first, shape (l,).

        phi_N(w_j) >= -lambda_k . w_j / sum_{i in N} h_i(lambda_k), over the `sharpest` cuts for this subset.
        """
        sums = self.values[:, subset].sum(axis=1)
        if len(sums) > sharpest:
            chosen = np.argpartition(sums, sharpest)[:sharpest]
            sums, loads = sums[chosen], self.loads[chosen]
        else:
            loads = self.loads
        floor = np.finfo(float).tiny
        return np.argsort(-(loads / np.maximum(sums, floor)[:, None]).max(axis=0), kind="stable")
