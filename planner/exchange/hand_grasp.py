"""A whole hand beside an object, as other tools' files hold it.

The planner never makes one: it plans fingertips, and inventing the hand behind them is another program's work.
Such grasps come from foreign files and go to foreign files. Frames: O the object's, H the hand's base; SI.
"""

from dataclasses import dataclass

from planner.arrays import Floats


@dataclass(frozen=True, eq=False, kw_only=True)
class HandGrasp:
    """Pose and joint positions of a hand that grasps an object."""

    object_file: str
    """What the source calls the object."""

    object_scale: float
    """By which the source multiplies the object's mesh."""

    position: Floats
    """Origin of H in O, shape (3,) [m]."""

    quaternion: Floats
    """Orientation R_OH as unit quaternion w, x, y, z, shape (4,)."""

    joint_names: tuple[str, ...]
    """Names of the joints; empty where the source does not name them."""

    joints: Floats
    """Joint positions in the grasp, shape (joints,) [rad or m]."""

    pregrasp_joints: Floats
    """Joint positions before it, shape (joints,) [rad or m]."""

    held: bool | None
    """Whether the source's own simulation says that the object was held; None where it does not say."""
