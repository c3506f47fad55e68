"""A box of wrenches: the paper's Case III."""

from itertools import product

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.errors import TaskError
from planner.wrench_sets.values import center_vector, half_sizes


class WrenchBox(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { c + (f, m) : |f_k| <= F_k, |m_k| <= M_k }.

    A half-width of zero makes the box flat along that axis.

    Raises:
        TaskError: On wrong counts, negative or non-finite values, or the box {0}.
    """

    force: tuple[float, ...]
    """Half-widths F of the force, 2 or 3 numbers [N]."""

    moment: tuple[float, ...]
    """Half-widths M of the moment, 1 number in the plane, 3 in space [N m]."""

    center: tuple[float, ...] | None = None
    """c, D numbers [N, N m]; the origin where left out."""

    def __post_init__(self) -> None:
        if not np.concatenate([self._half_widths, self._center]).any():
            raise TaskError("the box is the zero wrench alone: give a half-width or a center that is not zero")

    @property
    def _half_widths(self) -> Floats:
        return half_sizes(self.force, self.moment)

    @property
    def _center(self) -> Floats:
        return center_vector(self.center, len(self._half_widths))

    def vertices(self) -> Floats:
        """The box's own corners, shape (l, D), l = 2^(number of half-widths that are not zero)."""
        ends = [(-width, width) if width else (0.0,) for width in self._half_widths]
        return self._center + np.array(list(product(*ends)))

    def support(self, directions: Floats) -> Floats:
        """u.c + sum_k |u_k| (F, M)_k, shape (k,)."""
        return directions @ self._center + np.abs(directions) @ self._half_widths
