"""Any polytope, given by its vertices."""

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.errors import TaskError
from planner.wrench_sets.values import finite_vector


class WrenchPolytope(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = conv { w_1, ..., w_l }.

    Raises:
        TaskError: On no wrench, wrong or unequal counts, values that are not finite, or zero wrenches only.
    """

    wrenches: tuple[tuple[float, ...], ...]
    """w_j, each of D numbers [N, N m]."""

    def __post_init__(self) -> None:
        if not self.wrenches:
            raise TaskError("wrenches is empty: give at least one wrench of 3 (plane) or 6 (space) numbers")
        if not self._wrenches.any():
            raise TaskError("wrenches are all zero: no force is needed to resist them")

    @property
    def _wrenches(self) -> Floats:
        """Shape (l, D)."""
        dimension = len(finite_vector("wrenches[0]", self.wrenches[0], (3, 6)))
        return np.array(
            [finite_vector(f"wrenches[{j}]", wrench, (dimension,)) for j, wrench in enumerate(self.wrenches)]
        )

    def vertices(self) -> Floats:
        """The wrenches in the order given, without repetition, shape (l, D)."""
        wrenches = self._wrenches
        first = np.sort(np.unique(wrenches, axis=0, return_index=True)[1])
        return wrenches[first]

    def support(self, directions: Floats) -> Floats:
        """max_j u.w_j, shape (k,)."""
        return (directions @ self._wrenches.T).max(axis=1)
