"""Grasps as the JSON that GraspGen trains on: gripper poses in the object's frame, and whether each held the object.

A fingertip grasp cannot be written in it. The format pairs every single gripper pose with one truth value; a fingertip
alone does not hold the object, so `true` would be false, and `false` would teach that the contact is a bad one.
A hand's grasp can be, once a simulation has said whether it holds. Friction, torsional friction, forces and torques
have no place in the format.
"""

import json
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from planner.errors import OutputError
from planner.exchange.hand_grasp import HandGrasp
from planner.files.atomic_write import write_atomically
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable


def write_fingertips(path: Path, rigid_object: Graspable, grasp: Grasp, wrench: int | None = None) -> None:
    """Refuse: see above.

    Raises:
        OutputError: Always.
    """
    raise OutputError(
        f"cannot write {path}: GraspGen JSON holds gripper poses that each hold the object alone; these are "
        f"{len(grasp.contacts)} fingertips that hold it together, and there is no gripper. Write .isaac.yaml instead"
    )


def write_hand(path: Path, hand: HandGrasp) -> None:
    """Write the grasp of a hand that a foreign file holds.

    Raises:
        OutputError: When the source does not say whether the object was held, or the file cannot be written.
    """
    if hand.held is None:
        raise OutputError(
            f"cannot write {path}: GraspGen JSON says of every pose whether it holds the object, and the source does "
            "not say (no succ_flag). Evaluate it first, or write .isaac.yaml instead"
        )
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_quat(hand.quaternion, scalar_first=True).as_matrix()
    pose[:3, 3] = hand.position
    document = {
        "object": {"file": hand.object_file, "scale": hand.object_scale},
        "grasps": {"transforms": [pose.tolist()], "object_in_gripper": [hand.held]},
    }
    write_atomically(path, json.dumps(document, indent=1).encode() + b"\n")
