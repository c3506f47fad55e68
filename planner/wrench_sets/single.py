"""One wrench: the equilibrium grasp."""

import msgspec
import numpy as np

from planner.errors import TaskError
from planner.wrench_sets.values import finite_vector


class Single(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { w }.

    Raises:
        TaskError: On a wrong count, a value that is not finite, or the zero wrench.
    """

    wrench: tuple[float, ...]
    """w, D numbers [N, N m]."""

    def __post_init__(self) -> None:
        if not self._wrench.any():
            raise TaskError("wrench is zero: no force is needed to resist it")

    @property
    def _wrench(self) -> np.ndarray:
        return finite_vector("wrench", self.wrench, (3, 6))

    def vertices(self) -> np.ndarray:
        """The wrench, shape (1, D)."""
        return self._wrench[None]

    def support(self, directions: np.ndarray) -> np.ndarray:
        """u.w, shape (k,)."""
        return directions @ self._wrench
