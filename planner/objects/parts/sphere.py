"""The ball |p| <= r: one smooth facet."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.parts.tessellation import unit_sphere
from planner.objects.pose import Pose
from planner.objects.vectors import norm, unit


@dataclass(frozen=True, eq=False, kw_only=True)
class Sphere:
    """A sphere geom."""

    mjcf_type: ClassVar[str] = "sphere"

    geom: str
    """Name of the geom."""

    friction: float
    """Sliding friction coefficient."""

    pose: Pose
    """X_BG."""

    radius: float
    """r [m]."""

    @classmethod
    def placed(cls, pose: Pose, size: Floats, *, geom: str, friction: float) -> "Sphere":
        """See `Primitive.placed`."""
        return cls(geom=geom, friction=friction, pose=pose, radius=float(size[0]))

    @property
    def size(self) -> Floats:
        """MuJoCo's size vector, shape (1,) [m]."""
        return np.array([self.radius])

    def bounds(self) -> Floats:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        return np.stack([self.pose.position - self.radius, self.pose.position + self.radius])

    def triangles(self) -> tuple[Floats, Indices]:
        """See `ConvexPart.triangles`."""
        triangles = self.pose.to_body(self.radius * unit_sphere())
        return triangles, np.zeros(len(triangles), dtype=int)

    def nearest_facet(self, points: Floats) -> Indices:
        """See `ConvexPart.nearest_facet`."""
        return np.zeros(len(points), dtype=int)

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """See `ConvexPart.project`."""
        outward = unit(self.pose.to_local(points))
        return self.pose.to_body(self.radius * outward), self.pose.rotate(-outward)

    def depth(self, points: Floats) -> Floats:
        """See `ConvexPart.depth`."""
        return self.radius - norm(points - self.pose.position)
