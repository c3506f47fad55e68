"""How the object may move: freely in space, or in the plane z = 0 if it is the slab of a planar object."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from planner.arrays import Floats
from planner.objects.rigid_object import RigidObject
from sim.scene.dm_control_mjcf import mjcf


class ObjectJoints(Protocol):
    """Joints between the world and the object, whose coordinates come first in qpos and qvel."""

    @property
    def positions(self) -> int:
        """Numbers in qpos; the fingertips' begin after them."""

    @property
    def velocities(self) -> int:
        """Numbers in qvel."""

    @property
    def translations(self) -> int:
        """Numbers in qvel that are velocities along axes; those about axes follow."""

    def add_to(self, body: mjcf.Element) -> None:
        """Give the joints to the object's body, which stands at the origin."""

    def pose(self, qpos: Floats) -> tuple[Floats, Floats]:
        """Position, shape (n, 3) [m], and rotation (w, x, y, z), shape (n, 4), from qpos, shape (n, nq)."""


@dataclass(frozen=True)
class FreeJoint:
    """Six degrees of freedom."""

    positions: int = 7
    velocities: int = 6
    translations: int = 3

    def add_to(self, body: mjcf.Element) -> None:
        """See `ObjectJoints`."""
        body.add("freejoint")

    def pose(self, qpos: Floats) -> tuple[Floats, Floats]:
        """See `ObjectJoints`."""
        return qpos[:, :3].copy(), qpos[:, 3:7].copy()


@dataclass(frozen=True)
class PlanarJoints:
    """Slides along x and y, then a hinge about z."""

    positions: int = 3
    velocities: int = 3
    translations: int = 2

    def add_to(self, body: mjcf.Element) -> None:
        """See `ObjectJoints`."""
        for kind, axis in (("slide", (1, 0, 0)), ("slide", (0, 1, 0)), ("hinge", (0, 0, 1))):
            body.add("joint", type=kind, axis=axis)

    def pose(self, qpos: Floats) -> tuple[Floats, Floats]:
        """See `ObjectJoints`."""
        zero, half = np.zeros(len(qpos)), qpos[:, 2] / 2
        position = np.column_stack([qpos[:, 0], qpos[:, 1], zero])
        return position, np.column_stack([np.cos(half), zero, zero, np.sin(half)])


def joints_of(rigid_object: RigidObject) -> ObjectJoints:
    """The joints with which an object is simulated."""
    return PlanarJoints() if rigid_object.in_plane else FreeJoint()
