"""Grasps of DexGraspBench: one `.npy` per grasp with a pickled dictionary, read without running its pickle.

The hand's configurations are rows of seven numbers for its base (position, quaternion w, x, y, z) and then one per
joint, all in the frame of `obj_pose`. A fingertip grasp cannot be written so: it has neither base nor joints.
Nor has the format a place for friction, forces or torques: its simulation has its own friction, of condim 4.
"""

from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.errors import GraspFileError, OutputError
from planner.exchange.hand_grasp import HandGrasp
from planner.exchange.restricted_pickle import read_pickled_dictionary
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable

BASE = 7
"""Numbers of a pose."""


def write_fingertips(path: Path, rigid_object: Graspable, grasp: Grasp, wrench: int | None = None) -> None:
    """Refuse: see above.

    Raises:
        OutputError: Always.
    """
    raise OutputError(
        f"cannot write {path}: DexGraspBench needs the base pose and all joint positions of one of its hands "
        f"(pregrasp_qpos, grasp_qpos, squeeze_qpos); these are {len(grasp.contacts)} fingertips without a hand. "
        "Write .isaac.yaml instead"
    )


def read_hand(path: Path) -> HandGrasp:
    """Read one grasp.

    Raises:
        GraspFileError: When the file is missing, broken, holds more than arrays, or lacks what a grasp needs.
    """
    record = read_pickled_dictionary(path)
    try:
        return _hand(record)
    except (KeyError, ValueError, TypeError) as error:
        raise GraspFileError(f"{path} is not a grasp of DexGraspBench: {error!r}") from error


def _hand(record: dict[str, Any]) -> HandGrasp:
    base, pregrasp = _configuration(record, "grasp_qpos"), _configuration(record, "pregrasp_qpos")
    placed = _configuration(record, "obj_pose")
    names = tuple(map(str, record.get("joint_names", ())))
    if len(pregrasp) != len(base) or (names and len(names) != len(base) - BASE):
        raise ValueError(f"{len(base)} and {len(pregrasp)} numbers in the grasps, {len(names)} joint names")
    object_turn = Rotation.from_quat(placed[3:BASE], scalar_first=True)
    turn = object_turn.inv() * Rotation.from_quat(base[3:BASE], scalar_first=True)
    return HandGrasp(
        object_file=str(record["obj_path"]),
        object_scale=float(record["obj_scale"]),
        position=object_turn.inv().apply(base[:3] - placed[:3]),
        quaternion=turn.as_quat(scalar_first=True),
        joint_names=names,
        joints=base[BASE:],
        pregrasp_joints=pregrasp[BASE:],
        held=bool(record["succ_flag"]) if "succ_flag" in record else None,
    )


def _configuration(record: dict[str, Any], key: str) -> Floats:
    """A pose and the joint positions after it, shape (7 + joints,)."""
    values = np.asarray(record[key], dtype=float)
    if values.ndim != 1 or len(values) < BASE or not np.isfinite(values).all():
        raise ValueError(f"{key} has shape {values.shape}; expected {BASE} or more finite numbers")
    return values
