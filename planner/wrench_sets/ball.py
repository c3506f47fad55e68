"""A ball of wrenches, its moments made comparable with forces by a length."""

import msgspec

from planner.arrays import Floats
from planner.wrench_sets.ellipsoid import WrenchEllipsoid
from planner.wrench_sets.values import size, space_dimension


class WrenchBall(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { (f, m) : |f|^2 + (|m| / length)^2 <= radius^2 }.

    Raises:
        TaskError: When radius or length is not positive and finite, or on a dimension other than 2 and 3.
    """

    radius: float
    """Largest force [N]."""

    length: float
    """Ratio of the largest moment to the largest force [m]."""

    dimension: int = 3
    """d: 2 for the plane, 3 for space."""

    facets: int | None = None
    """Facets of the circumscribed polytope; see `circumscribed_ball`."""

    def __post_init__(self) -> None:
        size("radius", self.radius, zero=False)
        size("length", self.length, zero=False)
        space_dimension(self.dimension)

    @property
    def _ellipsoid(self) -> WrenchEllipsoid:
        moment = self.radius * self.length
        moments = (moment,) if self.dimension == 2 else (moment, moment, moment)
        return WrenchEllipsoid(force=self.dimension * (self.radius,), moment=moments, facets=self.facets)

    def vertices(self) -> Floats:
        """Vertices of the circumscribed polytope, shape (l, D)."""
        return self._ellipsoid.vertices()

    def support(self, directions: Floats) -> Floats:
        """radius |(u_f, length u_m)|, shape (k,)."""
        return self._ellipsoid.support(directions)
