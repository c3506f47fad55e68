"""The validation scene: the object floats at the origin, one free sphere touches it at every contact.

Composed with dm_control.mjcf in the units of the experiment (sim/similarity.py): world axes are the body
axes and the origin is the reference point, where the object's inertial frame lies too. MuJoCo applies
external forces at the centre of mass, so the force it is given is exactly the wrench about the reference point.
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from itertools import compress

import mujoco
import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.objects.rigid_object import ConvexPart
from sim.composer import mjcf
from sim.geometry import add_part
from sim.object_joints import FreeJoint, ObjectJoints
from sim.protocol import ValidationProtocol
from sim.similarity import Similarity

OBJECT = "object"
"""Name of the object's body."""
SENSOR = ("found", "force")
"""What every fingertip's contact sensor reports: number of contacts, then the force in the contact frame."""
SENSOR_WIDTH = 4
"""Numbers per sensor."""
PRECISION = 17
"""Digits that carry a double through XML unchanged."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Scene:
    """The compiled scene, in the units of the experiment."""

    model: mujoco.MjModel

    contacts: Contacts
    """Contacts where the fingertips were placed; friction is the simulated one."""

    object_body: int
    """Body id of the object."""

    object_geoms: np.ndarray
    """Geom ids of the object's parts, shape (parts,)."""

    tip_geoms: np.ndarray
    """Geom ids of the fingertips, shape (contacts,)."""

    tip_radius: float
    """[m]"""

    joints: ObjectJoints = field(default_factory=FreeJoint)
    """How the object may move; after its coordinates, qpos and qvel hold the fingertips' displacements from their
    anchors, three per finger."""


def build_scene(
    parts: Sequence[ConvexPart],
    contacts: Contacts,
    similarity: Similarity,
    protocol: ValidationProtocol,
    tip_radius: float,
    joints: ObjectJoints,
    spared: np.ndarray | None = None,
) -> Scene:
    """Compose and compile the scene.

    Args:
        parts: The object's collision geoms, in the body frame, SI.
        contacts: The grasp in the body frame, SI, with the friction to simulate.
        similarity: Map to the units of the experiment.
        protocol: Settings.
        tip_radius: Radius of the fingertips, relative to the reach.
        joints: How the object may move.
        spared: Parts that a fingertip never touches, shape (contacts, parts); none by default.

    Raises:
        SimulationError: When MuJoCo cannot compile the scene.
    """
    touching = similarity.contacts(contacts)
    radius = tip_radius * protocol.reach
    paired = np.ones((len(contacts), len(parts)), dtype=bool) if spared is None else ~spared
    root = _compose(parts, touching, similarity, protocol, radius, joints, paired)
    try:
        model = mujoco.MjModel.from_xml_string(root.to_xml_string(precision=PRECISION), root.get_assets())
    except ValueError as error:
        raise SimulationError(f"MuJoCo cannot compile the validation scene: {error}") from error
    lengths = np.where(np.arange(joints.velocities) < joints.translations, 1.0, protocol.reach)
    model.dof_damping[: joints.velocities] = protocol.object_damping * lengths**2
    return Scene(
        model=model,
        contacts=touching,
        object_body=model.body(OBJECT).id,
        object_geoms=np.array([model.geom(_part_name(part)).id for part in range(len(parts))]),
        tip_geoms=np.array([model.geom(_tip_name(finger)).id for finger in range(len(contacts))]),
        tip_radius=radius,
        joints=joints,
    )


def with_friction(scene: Scene, friction: np.ndarray) -> Scene:
    """The same scene with other friction coefficients, shape (contacts,).

    Raises:
        ContactError: When the friction is not one positive number per contact.
    """
    contacts = replace(scene.contacts, friction=friction)
    model = copy(scene.model)
    fingers = (model.pair_geom1[:, None] == scene.tip_geoms) | (model.pair_geom2[:, None] == scene.tip_geoms)
    model.pair_friction[:, :2] = friction[fingers.argmax(axis=1), None]
    return replace(scene, model=model, contacts=contacts)


def _compose(
    parts: Sequence[ConvexPart],
    contacts: Contacts,
    similarity: Similarity,
    protocol: ValidationProtocol,
    radius: float,
    joints: ObjectJoints,
    paired: np.ndarray,
) -> mjcf.RootElement:
    root = mjcf.RootElement(model="validation")
    _set_options(root, protocol)
    body = root.worldbody.add("body", name=OBJECT)
    joints.add_to(body)
    inertia = protocol.object_mass * protocol.reach**2
    body.add("inertial", pos=np.zeros(3), mass=protocol.object_mass, diaginertia=np.full(3, inertia))
    geoms = [add_part(body, _part_name(index), part, similarity) for index, part in enumerate(parts)]
    for finger in range(len(contacts)):
        _add_finger(root, list(compress(geoms, paired[finger])), contacts, finger, protocol, radius)
    return root


def _set_options(root: mjcf.RootElement, protocol: ValidationProtocol) -> None:
    root.option.set_attributes(
        timestep=protocol.timestep,
        integrator=protocol.integrator,
        cone=protocol.cone,
        jacobian=protocol.jacobian,
        solver=protocol.solver,
        iterations=protocol.iterations,
        tolerance=protocol.tolerance,
        impratio=protocol.impratio,
        noslip_iterations=protocol.noslip_iterations,
        ccd_tolerance=protocol.ccd_tolerance,
    )
    # W_R holds every load, gravity included; a simulation that diverges must not restart and look held
    root.option.flag.set_attributes(gravity="disable", autoreset="disable")


def _add_finger(
    root: mjcf.RootElement,
    geoms: Sequence[mjcf.Element],
    contacts: Contacts,
    finger: int,
    protocol: ValidationProtocol,
    radius: float,
) -> None:
    """A sphere that slides but does not turn, touching at its contact, and collides with the object only."""
    body = root.worldbody.add("body", pos=contacts.points[finger] - radius * contacts.normals[finger])
    for axis in np.eye(3):
        body.add("joint", type="slide", axis=axis)
    name = _tip_name(finger)
    tip = body.add("geom", name=name, type="sphere", size=[radius], mass=protocol.tip_mass, contype=0, conaffinity=0)
    sliding = contacts.friction[finger]
    for geom in geoms:
        root.contact.add(
            "pair",
            geom1=tip,
            geom2=geom,
            condim=3,
            friction=[sliding, sliding, 0, 0, 0],
            solref=protocol.solref,
            solimp=protocol.solimp,
            margin=0,
            gap=0,
        )
    root.sensor.add("contact", name=name, geom1=tip, data=" ".join(SENSOR), num=1, reduce="maxforce")


def _part_name(part: int) -> str:
    return f"part_{part}"


def _tip_name(finger: int) -> str:
    return f"tip_{finger}"
