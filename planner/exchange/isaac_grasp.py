"""Grasps as `isaac_grasp` YAML, the format that Isaac Sim's grasp editor imports.

The format states, per named grasp, where a gripper frame is in the object's frame, and the gripper's joint positions.
A fingertip grasp has no gripper and no joints, so what is written is exactly this and no more:

- one entry per fingertip. Its frame is the contact frame: origin at the contact, x along the inward normal. The
  entries `finger_1 … finger_m` hold the object together; none is a grasp of its own;
- `cspace_position` and `pregrasp_cspace_position` are empty: there are no joints;
- `confidence` is lower_bound / rho: one for a grasp proven best among its candidates.

Everything else (friction, forces, rho; of soft fingers torsion and torque) has no place in the format. It stands under
the key `rhograsp`, which the importer ignores.
"""

from pathlib import Path

from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.contacts import contact_frames
from planner.errors import GraspFileError
from planner.exchange.hand_grasp import HandGrasp
from planner.exchange.yaml_text import Value, yaml_text
from planner.files.atomic_write import write_atomically
from planner.grasps.grasp import Grasp
from planner.grasps.lift import in_space
from planner.objects.graspable import Graspable

FINGERTIP_FRAME = "rhograsp_fingertip"
"""Name of the frame at a contact, where the format asks for a gripper's."""

NOTE = (
    "Fingertips of one grasp, not alternatives: each entry is a contact frame with x along the inward normal. "
    "There is no hand, so cspace positions are empty."
)


def write_fingertips(path: Path, rigid_object: Graspable, grasp: Grasp, wrench: int | None = None) -> None:
    """Write the contact frames of a grasp, with the forces for one wrench, by default the critical one.

    Raises:
        GraspFileError: When the grasp has no contacts or no such wrench.
        OutputError: When the file cannot be written.
    """
    shown = wrench if wrench is not None else (grasp.critical_wrench if grasp.found else -1)
    if not grasp.found or not 0 <= shown < len(grasp.forces):
        raise GraspFileError(f"wrench {shown} of a grasp with forces for wrenches 0 to {len(grasp.forces) - 1}")
    _, grasp = in_space(rigid_object, grasp)
    contacts = grasp.contacts
    quaternions = Rotation.from_matrix(contact_frames(contacts.normals)).as_quat(scalar_first=True)
    names = [f"finger_{number + 1}" for number in range(len(contacts))]
    frames = zip(names, contacts.points, quaternions, strict=True)
    confidence = grasp.lower_bound / grasp.rho
    entries: dict[str, Value] = {name: _entry(confidence, point, turn, {}, {}) for name, point, turn in frames}
    ours: dict[str, Value] = {
        "note": NOTE,
        "rho": grasp.rho,
        "lower_bound": grasp.lower_bound,
        "wrench": grasp.task.wrenches[shown].tolist(),
        "reference_point": grasp.task.reference_point.tolist(),
        "fingers": {name: _finger(grasp, shown, finger) for finger, name in enumerate(names)},
    }
    _write(path, grasp.body, FINGERTIP_FRAME, entries, ours)


def _finger(grasp: Grasp, wrench: int, finger: int) -> dict[str, Value]:
    """What a finger can do and does under a wrench; strength is left out where it is 1, and of a hard finger torsion
    [m] and the torque about the inward normal [N m]."""
    contacts = grasp.contacts
    friction, strength, torsion = (
        float(values[finger]) for values in (contacts.friction, contacts.strengths, contacts.torsions)
    )
    return {
        "friction": friction,
        **({"torsion": torsion} if torsion else {}),
        **({} if strength == 1 else {"strength": strength}),
        "force": grasp.forces[wrench, finger].tolist(),
        **({"torque": float(grasp.torques[wrench, finger])} if torsion else {}),
    }


def write_hand(path: Path, hand: HandGrasp) -> None:
    """Write the grasp of a hand that a foreign file holds; joints without names stand under `rhograsp`.

    Raises:
        OutputError: When the file cannot be written.
    """
    named = bool(hand.joint_names)
    joints: dict[str, Value] = dict(zip(hand.joint_names, hand.joints.tolist(), strict=named))
    before: dict[str, Value] = dict(zip(hand.joint_names, hand.pregrasp_joints.tolist(), strict=named))
    ours: dict[str, Value] = {"object_file": hand.object_file, "object_scale": hand.object_scale}
    if not named:
        ours["note"] = "The source does not name its joints; their positions are in the source's order."
        ours |= {"joints": hand.joints.tolist(), "pregrasp_joints": hand.pregrasp_joints.tolist()}
    confidence = 0.0 if hand.held is None else float(hand.held)
    entry = _entry(confidence, hand.position, hand.quaternion, joints, before)
    _write(path, "object", "hand", {"grasp_0": entry}, ours)


def _entry(confidence: float, position: Floats, quaternion: Floats, joints: Value, pregrasp: Value) -> dict[str, Value]:
    w, *xyz = quaternion.tolist()
    return {
        "confidence": confidence,
        "position": position.tolist(),
        "orientation": {"w": w, "xyz": xyz},
        "cspace_position": joints,
        "pregrasp_cspace_position": pregrasp,
    }


def _write(path: Path, object_frame: str, gripper_frame: str, entries: Value, ours: Value) -> None:
    document: dict[str, Value] = {
        "format": "isaac_grasp",
        "format_version": 1.0,
        "object_frame": object_frame,
        "gripper_frame": gripper_frame,
        "grasps": entries,
        "rhograsp": ours,
    }
    write_atomically(path, yaml_text(document).encode())
