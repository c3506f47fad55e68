"""How an object is read from its file: what a user says of it, and what a grasp file remembers."""

from dataclasses import dataclass
from pathlib import Path

from planner.errors import ObjectError
from planner.objects.given_mass import NOTHING_GIVEN, GivenMass

ALL_JOINTS = "all"
"""In place of joints by their names."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ObjectSource:
    """Everything that decides which rigid object comes out of a file.

    Raises:
        ObjectError: On a keyframe without locked joints, which it would place.
    """

    file: Path
    """MJCF, or the outline of a planar object."""

    body: str | None = None
    """The body whose frame is B and which fingers may touch, with what is rigidly below it; None for the outermost
    body of the only object. What is rigidly tied to it belongs to the object all the same."""

    given: GivenMass = NOTHING_GIVEN
    """Mass properties in place of the file's."""

    locked_joints: tuple[str, ...] = ()
    """Joints between the object's bodies that are frozen, by name, or ALL_JOINTS."""

    keyframe: str | None = None
    """The keyframe at which they are frozen; None for the file's initial configuration qpos0."""

    def __post_init__(self) -> None:
        if self.keyframe is not None and not self.locked_joints:
            raise ObjectError(
                f"keyframe '{self.keyframe}' is to place joints, but none is locked; add --lock-joints, or leave "
                "--keyframe out"
            )
