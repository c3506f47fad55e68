"""A scene: the object and the fingertips that touch it, composed with dm_control.mjcf and compiled."""

from copy import copy
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError
from sim.scene.dm_control_mjcf import mjcf
from sim.scene.fingertips import Fingertips, pair_friction, tip_name
from sim.scene.floating_object import OBJECT, FloatingObject, part_name
from sim.scene.object_joints import ObjectJoints
from sim.scene.physics import Physics

PRECISION = 17
"""Digits that carry a double through XML unchanged."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Scene:
    """The compiled scene. World axes and origin are those of the object's body at the start."""

    model: mujoco.MjModel

    contacts: Contacts
    """Contacts where the fingertips were placed; friction and torsional friction are the simulated ones."""

    object_body: int
    """Body id of the object."""

    object_geoms: np.ndarray
    """Geom ids of the object's parts, shape (parts,)."""

    tip_geoms: np.ndarray
    """Geom ids of the fingertips, shape (contacts,)."""

    tip_radius: float
    """[m]"""

    joints: ObjectJoints
    """How the object may move; after its coordinates, qpos and qvel hold the fingertips' displacements from their
    anchors, three per finger."""


def build_scene(held: FloatingObject, fingertips: Fingertips, physics: Physics) -> Scene:
    """Compose and compile.

    Args:
        held: The object.
        fingertips: What touches it.
        physics: Settings.

    Raises:
        SimulationError: When MuJoCo cannot compile the scene.
    """
    root = mjcf.RootElement(model="scene")
    physics.set_options(root)
    fingertips.attach(root, held.attach(root), physics)
    try:
        model = mujoco.MjModel.from_xml_string(root.to_xml_string(precision=PRECISION), root.get_assets())
    except ValueError as error:
        raise SimulationError(f"MuJoCo cannot compile the scene: {error}") from error
    model.dof_damping[: held.joints.velocities] = held.damping
    return Scene(
        model=model,
        contacts=fingertips.contacts,
        object_body=model.body(OBJECT).id,
        object_geoms=np.array([model.geom(part_name(part)).id for part in range(len(held.parts))]),
        tip_geoms=np.array([model.geom(tip_name(finger)).id for finger in range(len(fingertips.contacts))]),
        tip_radius=fingertips.radius,
        joints=held.joints,
    )


def with_friction(scene: Scene, contacts: Contacts) -> Scene:
    """The same scene with other friction and torsional friction.

    Args:
        scene: Stays as it is.
        contacts: Those of the scene, in its units, but for friction and torsion.

    Raises:
        SimulationError: When a torsional friction is too small for MuJoCo.
    """
    model = copy(scene.model)
    fingers = (model.pair_geom1[:, None] == scene.tip_geoms) | (model.pair_geom2[:, None] == scene.tip_geoms)
    condim, friction = pair_friction(contacts)
    model.pair_dim[:], model.pair_friction[:] = condim[fingers.argmax(axis=1)], friction[fingers.argmax(axis=1)]
    return replace(scene, model=model, contacts=contacts)
