"""The points with x^2 + y^2 <= r^2 and |z| <= h: facet 0 is the side, 1 the cap at +h, 2 the cap at -h."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.parts.tessellation import unit_disc, unit_tube
from planner.objects.pose import Pose
from planner.objects.vectors import norm, unit

SIDE, TOP, BOTTOM = 0, 1, 2


@dataclass(frozen=True, eq=False, kw_only=True)
class Cylinder:
    """A cylinder geom, its axis along z of its own frame."""

    mjcf_type: ClassVar[str] = "cylinder"

    geom: str
    """Name of the geom."""

    friction: float
    """Sliding friction coefficient."""

    pose: Pose
    """X_BG."""

    radius: float
    """r [m]."""

    half_length: float
    """h [m]."""

    @classmethod
    def placed(cls, pose: Pose, size: Floats, *, geom: str, friction: float) -> "Cylinder":
        """See `Primitive.placed`."""
        return cls(geom=geom, friction=friction, pose=pose, radius=float(size[0]), half_length=float(size[1]))

    @property
    def size(self) -> Floats:
        """MuJoCo's size vector, shape (2,) [m]."""
        return np.array([self.radius, self.half_length])

    def bounds(self) -> Floats:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        axis = self.pose.rotation[:, 2]
        reach = self.half_length * np.abs(axis) + self.radius * np.sqrt(np.maximum(1 - axis * axis, 0))
        return np.stack([self.pose.position - reach, self.pose.position + reach])

    def triangles(self) -> tuple[Floats, Indices]:
        """See `ConvexPart.triangles`."""
        scale = np.array([self.radius, self.radius, self.half_length])
        disc, lift = unit_disc(), np.array([0.0, 0.0, 1.0])
        pieces = [unit_tube(), disc + lift, disc[:, ::-1] - lift]
        facets = np.repeat([SIDE, TOP, BOTTOM], [len(piece) for piece in pieces])
        return self.pose.to_body(np.concatenate(pieces) * scale), facets

    def nearest_facet(self, points: Floats) -> Indices:
        """See `ConvexPart.nearest_facet`."""
        local = self.pose.to_local(points)
        nearer_cap = np.where(local[:, 2] >= 0, TOP, BOTTOM)
        return np.where(self._side_depth(local) <= self._cap_depth(local), SIDE, nearer_cap)

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """See `ConvexPart.project`."""
        local = self.pose.to_local(points)
        radial = unit(local[:, :2])
        on_side = (facets == SIDE)[:, None]
        lift = np.where(facets == TOP, 1.0, -1.0)
        reach = np.minimum(norm(local[:, :2]), self.radius)[:, None]
        across = np.where(on_side, self.radius, reach) * radial
        along = np.where(
            on_side[:, 0], np.clip(local[:, 2], -self.half_length, self.half_length), self.half_length * lift
        )
        outward = np.column_stack([radial * on_side, np.where(on_side[:, 0], 0.0, lift)])
        return self.pose.to_body(np.column_stack([across, along])), self.pose.rotate(-outward)

    def depth(self, points: Floats) -> Floats:
        """See `ConvexPart.depth`."""
        local = self.pose.to_local(points)
        return np.minimum(self._side_depth(local), self._cap_depth(local))

    def _side_depth(self, local: Floats) -> Floats:
        return self.radius - norm(local[:, :2])

    def _cap_depth(self, local: Floats) -> Floats:
        return self.half_length - np.abs(local[:, 2])
