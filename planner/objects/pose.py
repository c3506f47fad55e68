"""The pose X_BG of a geom's own frame G in the object's body frame B.

Written with elementwise arithmetic only, so that every platform computes the same bits.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planner.arrays import Floats


@dataclass(frozen=True, eq=False, kw_only=True)
class Pose:
    """A rigid placement: p_B = position + R_BG p_G."""

    position: Floats
    """Origin of G, shape (3,) [m]."""

    quaternion: Floats
    """Rotation R_BG as a unit quaternion w, x, y, z, shape (4,)."""

    @classmethod
    def identity(cls) -> "Pose":
        """The pose of B itself."""
        return cls(position=np.zeros(3), quaternion=np.array([1.0, 0.0, 0.0, 0.0]))

    @cached_property
    def rotation(self) -> Floats:
        """Rotation matrix R_BG, shape (3, 3); its columns are the axes of G."""
        w, x, y, z = self.quaternion / np.sqrt((self.quaternion * self.quaternion).sum())
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )

    @property
    def angle(self) -> float:
        """Of the rotation, between 0 and pi [rad]."""
        w, *xyz = self.quaternion
        return float(2 * np.arctan2(np.linalg.norm(xyz), abs(w)))

    @property
    def axis(self) -> Floats:
        """About which it turns by `angle`, a unit vector, shape (3,); zero without a turn."""
        w, *xyz = self.quaternion
        length = np.linalg.norm(xyz)
        return np.array(xyz) / length * np.copysign(1.0, w) if length > 0 else np.zeros(3)

    def rotate(self, vectors: Floats) -> Floats:
        """Free vectors of G in the axes of B, shape (..., 3)."""
        return _combine(vectors, self.rotation.T)

    def to_body(self, points: Floats) -> Floats:
        """Points of G in B, shape (..., 3) [m]."""
        return self.position + self.rotate(points)

    def to_local(self, points: Floats) -> Floats:
        """Points of B in G, shape (..., 3) [m]."""
        return _combine(points - self.position, self.rotation)

    def inverse(self) -> "Pose":
        """X_GB, the pose of B in G."""
        conjugate = Pose(position=np.zeros(3), quaternion=self.quaternion * np.array([1.0, -1.0, -1.0, -1.0]))
        return Pose(position=conjugate.rotate(-self.position), quaternion=conjugate.quaternion)

    def compose(self, child: "Pose") -> "Pose":
        """Pose in B of a frame whose pose in G is `child`."""
        a, b, c, d = self.quaternion
        w, x, y, z = child.quaternion
        product = [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ]
        return Pose(position=self.to_body(child.position), quaternion=np.array(product))


def _combine(coefficients: Floats, rows: Floats) -> Floats:
    """sum_k coefficients[..., k] rows[k], in a fixed order of additions."""
    x, y, z = coefficients[..., 0:1], coefficients[..., 1:2], coefficients[..., 2:3]
    return x * rows[0] + y * rows[1] + z * rows[2]
