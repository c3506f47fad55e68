"""One wrench: the equilibrium grasp."""

import msgspec

from planner.arrays import Floats
from planner.errors import TaskError
from planner.wrench_sets.values import finite_vector


class SingleWrench(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
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
    def _wrench(self) -> Floats:
        return finite_vector("wrench", self.wrench, (3, 6))

    def vertices(self) -> Floats:
        """The wrench, shape (1, D)."""
        return self._wrench[None]

    def support(self, directions: Floats) -> Floats:
        """u.w, shape (k,)."""
        return directions @ self._wrench
