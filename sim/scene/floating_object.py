"""The object in a scene: its collision geoms on one body that floats."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from planner.arrays import Floats
from planner.objects.rigid_object import ConvexPart
from sim.scene.dm_control_mjcf import mjcf
from sim.scene.object_joints import FreeJoint, ObjectJoints
from sim.scene.part_geom import add_part
from sim.scene.units import Units

OBJECT = "object"
"""Name of the object's body."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FloatingObject:
    """A body at the origin of the scene, in the axes of B."""

    parts: Sequence[ConvexPart]
    """Collision geoms, in the body frame, SI."""

    units: Units
    """Map to the units of the scene."""

    mass: float
    """[kg]"""

    center_of_mass: Floats
    """Where external forces act, in the units of the scene, shape (3,) [m]."""

    inertia: Floats
    """About the centre of mass, shape (3, 3) [kg m^2]."""

    joints: ObjectJoints = field(default_factory=FreeJoint)
    """How it may move."""

    drag: float = 0.0
    """Against its motion [N s/m]; against its rotation that times the square of its radius of gyration."""

    @property
    def damping(self) -> Floats:
        """Of each of its joints, shape (velocities,) [N s/m, N m s]."""
        turning = np.trace(self.inertia) / (3 * self.mass)
        along = np.arange(self.joints.velocities) < self.joints.translations
        return self.drag * np.where(along, 1.0, turning)

    def attach(self, root: mjcf.RootElement) -> list[mjcf.Element]:
        """Add the body to a scene; returns its geoms, one for each part in order."""
        body = root.worldbody.add("body", name=OBJECT)
        self.joints.add_to(body)
        rows, columns = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
        body.add("inertial", pos=self.center_of_mass, mass=self.mass, fullinertia=self.inertia[rows, columns])
        return [add_part(body, part_name(index), part, self.units) for index, part in enumerate(self.parts)]


def part_name(part: int) -> str:
    """Name of the geom of a part."""
    return f"part_{part}"
