"""Motion large enough to be seen: the object's motion and the fingertips' slip, drawn several times larger.

A lost grasp moves by a percent of its size before the fingertips' springs catch it. With the object's pose (R, x),
R = exp([a]) for a rotation vector a, it is drawn at (exp([s a]), s x); a fingertip with centre c that has gone by d in
the object's frame is drawn at c + s d there. With s = 1 everything is where it is.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.objects.rigid_object import RigidObject
from sim.render.recording import Recording
from sim.scene.fingertips import TORQUE

VISIBLE = 0.1
"""How far the object's outermost point should move in the picture, relative to its size."""
STEEPEST_TURN = 0.4
"""How far the object may turn in the picture where its motion is enlarged [rad]."""
FACTORS = (1, 2, 3, 5, 10, 20, 30, 50, 100)
"""By how much motion is enlarged."""
AVERAGED = 10
"""Steps over whose forces the mean is drawn: a sliding contact chatters faster than a film can show."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnPose:
    """Where things are drawn, in the world frame of the experiment."""

    position: Floats
    """Of the object, shape (3,) [m]."""

    rotation: Floats
    """Of the object, shape (3, 3)."""

    tips: Floats
    """Centres of the fingertips, shape (contacts, 3) [m]."""

    contacts: Floats
    """Where the fingertips face the object, shape (contacts, 3) [m]."""

    normals: Floats
    """Inward normals of the planned contacts, turned with the object, shape (contacts, 3)."""

    forces: Floats
    """Measured forces on the object in the last AVERAGED steps, turned with it, shape (contacts, 3) [N]."""

    torques: Floats
    """Measured torques on the object about these normals in the same steps, shape (contacts,) [N m]."""


def motion_factor(recording: Recording, rigid_object: RigidObject) -> int:
    """By how much the motion of a recording must be enlarged to be seen.

    Rotations stay moderate, no fingertip may sink into the object, and a motion within the tolerances of a hold is not
    enlarged until it looks like a loss.

    Args:
        recording: All its simulations are drawn alike.
        rigid_object: What is held, in the body frame, SI.
    """
    protocol, units = recording.experiment.protocol, recording.experiment.units
    size, lost = rigid_object.size * units.length, protocol.gone * protocol.motion_tolerance
    shift, turn = lost * protocol.reach, lost
    for simulation in range(len(recording.trial.caps)):
        positions, quaternions, _ = recording.motion(simulation)
        shift = max(shift, float(np.linalg.norm(positions, axis=1).max()))
        turn = max(turn, float(Rotation.from_quat(quaternions, scalar_first=True).magnitude().max()))
    largest = min(VISIBLE * size / (shift + turn * size / 2), STEEPEST_TURN / turn)
    for factor in sorted(FACTORS, reverse=True):
        if factor <= largest and not _sinks(recording, rigid_object, factor):
            return factor
    return 1


def _sinks(recording: Recording, rigid_object: RigidObject, factor: float) -> bool:
    """Whether some fingertip's centre is drawn inside the object at the end."""
    units = recording.experiment.units
    for simulation in range(len(recording.trial.caps)):
        pose = drawn_pose(recording, recording.steps - 1, simulation, factor)
        centers = (pose.tips - pose.position) @ pose.rotation / units.length + units.reference_point
        if any((part.depth(centers) > 0).any() for part in rigid_object.parts):
            return True
    return False


def drawn_pose(recording: Recording, step: int, simulation: int, factor: float) -> DrawnPose:
    """Where things are drawn at the beginning of a step, with the forces measured until its end.

    Forces turn with the object: an arrow keeps its angle to the friction cone, which is what matters.
    """
    scene = recording.experiment.scene
    positions, quaternions, displacements = recording.motion(simulation)
    rotation = Rotation.from_quat(quaternions[step], scalar_first=True)
    drawn = Rotation.from_rotvec(factor * rotation.as_rotvec())
    normals = scene.contacts.normals
    centers = scene.contacts.points - scene.tip_radius * normals
    gone = rotation.inv().apply(centers + displacements[step] - positions[step]) - centers
    tips = drawn.apply(centers + factor * gone) + factor * positions[step]
    past = range(max(0, step + 1 - AVERAGED), step + 1)
    measured = [recording.forces(each, simulation) for each in past]
    return DrawnPose(
        position=factor * positions[step],
        rotation=drawn.as_matrix(),
        tips=tips,
        contacts=tips + scene.tip_radius * drawn.apply(normals),
        normals=drawn.apply(normals),
        forces=drawn.apply(rotation.inv().apply(np.mean(measured, axis=0))),
        torques=recording.readings[past, simulation, :, TORQUE].mean(axis=0),
    )
