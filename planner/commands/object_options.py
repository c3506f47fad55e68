"""The options that say how an object is read, the same for every command that takes an object's file."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

from planner.terminal.command_line import Given

if TYPE_CHECKING:
    from planner.objects.object_source import ObjectSource


@dataclass(frozen=True, kw_only=True)
class ObjectOptions:
    """Which object, and how it is read from its file."""

    object: tyro.conf.Positional[Path]
    """MJCF file of the object: what MuJoCo collides is what is planned on. Or the .toml file of a planar one."""

    body: Given[str] = None
    """Body that fingers may touch, with what is fixed below it; by default all of the only object in the file. What the
    body is fixed to belongs to the object all the same. Forces, moments and points are in the frame of this body."""

    mass: Given[float] = None
    """Mass of the object in kg, where its file has none or a wrong one."""

    com: Given[tuple[float, float, float]] = None
    """Centre of mass in the body frame in metres, where the file's is wrong."""

    lock_joints: Given[tuple[str, ...]] = None
    """Joints between the object's bodies to freeze, so that it is one rigid object: their names, or "all"."""

    keyframe: Given[str] = None
    """Keyframe of the file at which joints are frozen; by default they are where the file puts them (qpos0)."""

    @property
    def source(self) -> "ObjectSource":
        """How the object is read.

        Raises:
            ObjectError: If mass or centre of mass are out of range, or a keyframe has no joints to place.
        """
        from planner.objects.given_mass import given_mass  # here: the help must not wait for NumPy
        from planner.objects.object_source import ALL_JOINTS, ObjectSource

        locked = () if self.lock_joints is None else self.lock_joints or (ALL_JOINTS,)
        return ObjectSource(
            file=self.object,
            body=self.body,
            given=given_mass(self.mass, self.com),
            locked_joints=locked,
            keyframe=self.keyframe,
        )
