"""The points within r of the segment |z| <= h: one smooth facet, side and both hemispheres."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.parts.tessellation import unit_sphere, unit_tube
from planner.objects.pose import Pose
from planner.objects.vectors import norm, unit


@dataclass(frozen=True, eq=False, kw_only=True)
class Capsule:
    """A capsule geom, its axis along z of its own frame."""

    mjcf_type: ClassVar[str] = "capsule"

    geom: str
    """Name of the geom."""

    friction: float
    """Sliding friction coefficient."""

    pose: Pose
    """X_BG."""

    radius: float
    """r [m]."""

    half_length: float
    """h, half the length of the segment [m]."""

    @classmethod
    def placed(cls, pose: Pose, size: Floats, *, geom: str, friction: float) -> "Capsule":
        """See `Primitive.placed`."""
        return cls(geom=geom, friction=friction, pose=pose, radius=float(size[0]), half_length=float(size[1]))

    @property
    def size(self) -> Floats:
        """MuJoCo's size vector, shape (2,) [m]."""
        return np.array([self.radius, self.half_length])

    def bounds(self) -> Floats:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        reach = self.radius + self.half_length * np.abs(self.pose.rotation[:, 2])
        return np.stack([self.pose.position - reach, self.pose.position + reach])

    def triangles(self) -> tuple[Floats, Indices]:
        """See `ConvexPart.triangles`."""
        caps = self.radius * unit_sphere()
        caps[..., 2] += self.half_length * np.sign(caps[..., 2].mean(axis=1))[:, None]
        side = unit_tube() * [self.radius, self.radius, self.half_length]
        triangles = self.pose.to_body(np.concatenate([side, caps]))
        return triangles, np.zeros(len(triangles), dtype=int)

    def nearest_facet(self, points: Floats) -> Indices:
        """See `ConvexPart.nearest_facet`."""
        return np.zeros(len(points), dtype=int)

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """See `ConvexPart.project`."""
        axis_points, outward = self._foot(points)
        return self.pose.to_body(axis_points + self.radius * unit(outward)), self.pose.rotate(-unit(outward))

    def depth(self, points: Floats) -> Floats:
        """See `ConvexPart.depth`."""
        return self.radius - norm(self._foot(points)[1])

    def _foot(self, points: Floats) -> tuple[Floats, Floats]:
        """Nearest point of the segment, and the way from it to each point, in the geom's frame."""
        local = self.pose.to_local(points)
        foot = np.zeros_like(local)
        foot[:, 2] = np.clip(local[:, 2], -self.half_length, self.half_length)
        return foot, local - foot
