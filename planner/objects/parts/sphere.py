"""The ball |p| <= r: one smooth facet."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

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
    def placed(cls, pose: Pose, size: np.ndarray, *, geom: str, friction: float) -> "Sphere":
        """See `Primitive.placed`."""
        return cls(geom=geom, friction=friction, pose=pose, radius=float(size[0]))

    @property
    def size(self) -> np.ndarray:
        """MuJoCo's size vector, shape (1,) [m]."""
        return np.array([self.radius])

    def bounds(self) -> np.ndarray:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        return np.stack([self.pose.position - self.radius, self.pose.position + self.radius])

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """See `ConvexPart.triangles`."""
        triangles = self.pose.to_body(self.radius * unit_sphere())
        return triangles, np.zeros(len(triangles), dtype=int)

    def nearest_facet(self, points: np.ndarray) -> np.ndarray:
        """See `ConvexPart.nearest_facet`."""
        return np.zeros(len(points), dtype=int)

    def project(self, points: np.ndarray, facets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `ConvexPart.project`."""
        outward = unit(self.pose.to_local(points))
        return self.pose.to_body(self.radius * outward), self.pose.rotate(-outward)

    def depth(self, points: np.ndarray) -> np.ndarray:
        """See `ConvexPart.depth`."""
        return self.radius - norm(points - self.pose.position)
