"""The points with |x| <= a, |y| <= b, |z| <= c: a polyhedron that remembers it is a box."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from planner.arrays import Floats
from planner.objects.parts.hull import convex_facets
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.pose import Pose

CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


@dataclass(frozen=True, eq=False, kw_only=True)
class Box(Polyhedron):
    """A box geom."""

    mjcf_type: ClassVar[str] = "box"

    pose: Pose
    """X_BG."""

    half_lengths: Floats
    """a, b, c along the axes of its own frame, shape (3,) [m]."""

    @property
    def size(self) -> Floats:
        """MuJoCo's size vector, shape (3,) [m]."""
        return self.half_lengths

    @classmethod
    def placed(cls, pose: Pose, size: Floats, *, geom: str, friction: float) -> "Box":
        """The box of these half edge lengths, shape (3,) [m], at `pose`; see `Primitive.placed`.

        Raises:
            ObjectError: If it is flat.
        """
        facets = convex_facets(pose.to_body(CORNERS * size), geom)
        return cls(geom=geom, friction=friction, pose=pose, half_lengths=size, **facets._asdict())
