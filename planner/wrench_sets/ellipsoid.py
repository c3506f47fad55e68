"""An ellipsoid of wrenches: the task ellipsoid of Li and Sastry (1988)."""

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension
from planner.errors import TaskError
from planner.wrench_sets.circumscribed import circumscribed_ball
from planner.wrench_sets.values import center_vector, half_sizes

ORTHONORMAL = 1e-6
"""Largest accepted deviation of R^T R from the identity."""


class WrenchEllipsoid(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { c + R diag(a) u : |u| <= 1 }.

    A semi-axis of zero makes the ellipsoid flat along that axis.

    Raises:
        TaskError: On wrong counts, negative or non-finite values, no positive semi-axis, or a matrix that
            is no rotation.
    """

    force: tuple[float, ...]
    """Semi-axes a of the force, 2 or 3 numbers [N]."""

    moment: tuple[float, ...]
    """Semi-axes a of the moment, 1 number in the plane, 3 in space [N m]."""

    center: tuple[float, ...] | None = None
    """c, D numbers [N, N m]; the origin where left out."""

    rotation: tuple[tuple[float, ...], ...] | None = None
    """Rows of the d x d rotation that takes the ellipsoid's axes to those of B; the identity where left
    out. It turns force and moment alike."""

    facets: int | None = None
    """Facets of the circumscribed polytope; see `circumscribed_ball`."""

    def __post_init__(self) -> None:
        if not self._semi_axes.any():
            raise TaskError('an ellipsoid needs a positive semi-axis; one wrench alone is kind = "single"')
        center_vector(self.center, len(self._semi_axes))
        rotation = self._rotation[: len(self.force), : len(self.force)]
        error = np.abs(rotation.T @ rotation - np.eye(len(rotation))).max()
        if not error < ORTHONORMAL or np.linalg.det(rotation) < 0:  # an error that is no number is refused too
            raise TaskError(f"rotation must be orthonormal with determinant +1, got {self.rotation}")

    @property
    def _semi_axes(self) -> Floats:
        return half_sizes(self.force, self.moment)

    @property
    def _rotation(self) -> Floats:
        """The rotation acting on wrenches, shape (D, D)."""
        dimension = len(self.force)
        if self.rotation is None:
            return np.eye(wrench_dimension(dimension))
        if [len(row) for row in self.rotation] != dimension * [dimension]:
            raise TaskError(f"rotation must be {dimension} rows of {dimension} numbers, got {self.rotation}")
        turn = np.zeros((wrench_dimension(dimension),) * 2)
        turn[:dimension, :dimension] = self.rotation
        turn[dimension:, dimension:] = self.rotation if dimension == 3 else 1.0
        return turn

    @property
    def _map(self) -> Floats:
        """R diag(a) without its zero columns, shape (D, number of positive semi-axes)."""
        semi_axes = self._semi_axes
        return (self._rotation * semi_axes)[:, semi_axes > 0]

    def vertices(self) -> Floats:
        """The image of a polytope around the unit ball, shape (l, D)."""
        linear = self._map
        ball = circumscribed_ball(linear.shape[1], self.facets)
        return center_vector(self.center, len(linear)) + ball @ linear.T

    def support(self, directions: Floats) -> Floats:
        """u.c + |diag(a) R^T u|, shape (k,)."""
        linear = self._map
        center = center_vector(self.center, len(linear))
        return directions @ center + np.linalg.norm(directions @ linear, axis=1)
