"""The points with (x/a)^2 + (y/b)^2 + (z/c)^2 <= 1: one smooth facet."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.parts.tessellation import unit_sphere
from planner.objects.pose import Pose
from planner.objects.vectors import norm, unit

NEWTON_STEPS = 60
"""More than enough: from the left the iteration is monotone and finally quadratic."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Ellipsoid:
    """An ellipsoid geom."""

    mjcf_type: ClassVar[str] = "ellipsoid"

    geom: str
    """Name of the geom."""

    friction: float
    """Sliding friction coefficient."""

    pose: Pose
    """X_BG."""

    semi_axes: Floats
    """a, b, c along the axes of its own frame, shape (3,) [m]."""

    @classmethod
    def placed(cls, pose: Pose, size: Floats, *, geom: str, friction: float) -> "Ellipsoid":
        """See `Primitive.placed`."""
        return cls(geom=geom, friction=friction, pose=pose, semi_axes=size)

    @property
    def size(self) -> Floats:
        """MuJoCo's size vector, shape (3,) [m]."""
        return self.semi_axes

    def bounds(self) -> Floats:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        reach = norm(self.pose.rotation * self.semi_axes)
        return np.stack([self.pose.position - reach, self.pose.position + reach])

    def triangles(self) -> tuple[Floats, Indices]:
        """See `ConvexPart.triangles`."""
        triangles = self.pose.to_body(unit_sphere() * self.semi_axes)
        return triangles, np.zeros(len(triangles), dtype=int)

    def nearest_facet(self, points: Floats) -> Indices:
        """See `ConvexPart.nearest_facet`."""
        return np.zeros(len(points), dtype=int)

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """See `ConvexPart.project`."""
        gauge = self._nearest(self.pose.to_local(points)) / self.semi_axes
        on_sphere = unit(gauge)
        gradient = on_sphere / self.semi_axes
        return self.pose.to_body(on_sphere * self.semi_axes), self.pose.rotate(-unit(gradient))

    def depth(self, points: Floats) -> Floats:
        """See `ConvexPart.depth`; magnitude: the shortest semi-axis times 1 - gauge."""
        gauge = norm(self.pose.to_local(points) / self.semi_axes)
        return self.semi_axes.min() * (1 - gauge)

    def _nearest(self, local: Floats) -> Floats:
        """Nearest points of the surface: x_k = a_k^2 y_k / (t + a_k^2), with t the largest root of

            F(t) = sum_k (a_k y_k / (t + a_k^2))^2 - 1.

        F is convex and falls right of -min a_k^2, and Newton started where one term alone reaches 1 climbs
        to the root from the left. Lengths are scaled by the shortest semi-axis, coordinates kept off zero so
        that a point of the medial axis has some nearest point rather than none. Source: Eberly, Distance
        from a point to an ellipse, an ellipsoid, or a hyperellipsoid (2013).
        """
        unit_length = self.semi_axes.min()
        axes = self.semi_axes / unit_length
        point = np.maximum(np.abs(local) / unit_length, 1e-15 * axes)
        shift = (axes * point - axes * axes).max(axis=1)
        for _ in range(NEWTON_STEPS):
            terms = axes * point / (shift[:, None] + axes * axes)
            excess = (terms * terms).sum(axis=1) - 1
            slope = -2 * (terms * terms / (shift[:, None] + axes * axes)).sum(axis=1)
            shift = shift - np.minimum(excess / slope, 0.0)
        nearest = axes * axes * point / (shift[:, None] + axes * axes)
        return np.copysign(nearest, local) * unit_length
