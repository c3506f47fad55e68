"""The shapes that MuJoCo knows by a pose and a size, by the name it gives their geoms.

To add one: write its class in a file of its own, with what `Primitive` asks, and name it here; reader, writer and the
simulation's scene follow.
"""

from typing import Protocol, runtime_checkable

from planner.arrays import Floats
from planner.objects.parts.box import Box
from planner.objects.parts.capsule import Capsule
from planner.objects.parts.cylinder import Cylinder
from planner.objects.parts.ellipsoid import Ellipsoid
from planner.objects.parts.sphere import Sphere
from planner.objects.pose import Pose
from planner.objects.rigid_object import ConvexPart


@runtime_checkable
class Primitive(ConvexPart, Protocol):
    """A convex part of such a shape."""

    @property
    def pose(self) -> Pose:
        """X_BG."""

    @property
    def size(self) -> Floats:
        """MuJoCo's size vector, without the numbers that this shape does not use [m]."""

    @classmethod
    def placed(cls, pose: Pose, size: Floats, *, geom: str, friction: float) -> ConvexPart:
        """The part of a geom.

        Args:
            pose: X_BG.
            size: MuJoCo's size vector, shape (3,) [m].
            geom: Name of the geom.
            friction: Sliding friction coefficient.

        Raises:
            ObjectError: If it is no solid.
        """


PRIMITIVES: dict[str, type[Primitive]] = {
    "box": Box,
    "capsule": Capsule,
    "cylinder": Cylinder,
    "ellipsoid": Ellipsoid,
    "sphere": Sphere,
}
