"""The world of another group's test: the object as heavy as they make it, fingertips in place of their hand.

Composed with dm_control.mjcf in real units: world axes and origin are those of the body frame B at the start. External
forces act at the object's true centre of mass.
"""

from itertools import compress

import mujoco
import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.objects.rigid_object import RigidObject
from planner.objects.touch import TIP
from sim.benches.settings import BenchSettings
from sim.composer import mjcf
from sim.geometry import add_part
from sim.scene import OBJECT, PRECISION, SENSOR, Scene
from sim.similarity import Similarity
from sim.static_check import check_touch

REAL = Similarity(reference_point=np.zeros(3), length=1.0, force=1.0)
"""Real metres and newtons, body frame."""


def build_world(rigid_object: RigidObject, contacts: Contacts, settings: BenchSettings) -> Scene:
    """Compose and compile, with the largest fingertips that touch only where planned.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp in the body frame; the friction is not used.
        settings: The test.

    Raises:
        SimulationError: When MuJoCo cannot compile the world, or a fingertip is not where it was planned.
    """
    if contacts.dimension != 3:
        raise SimulationError("only grasps in space can be simulated; this one is planar")
    reach = float(np.linalg.norm(contacts.points - rigid_object.center_of_mass, axis=1).max(initial=0))
    if not reach > 0:
        raise SimulationError("no contact away from the centre of mass: nothing to hold the object with")
    every_pair = np.ones((len(contacts), len(rigid_object.parts)), dtype=bool)
    radii = (*(part * reach for part in settings.tip_radii), TIP * rigid_object.size)
    for radius in sorted(radii, reverse=True):
        scene = _compiled(rigid_object, contacts, settings, radius, every_pair)
        static = check_touch(scene, rigid_object.size, 1.0)
        if not static.reasons():
            return _compiled(rigid_object, contacts, settings, radius, ~static.spared) if static.spared.any() else scene
    raise SimulationError("; ".join(static.reasons()))


def _compiled(
    rigid_object: RigidObject, contacts: Contacts, settings: BenchSettings, radius: float, paired: np.ndarray
) -> Scene:
    root = _compose(rigid_object, contacts, settings, radius, paired)
    try:
        model = mujoco.MjModel.from_xml_string(root.to_xml_string(precision=PRECISION), root.get_assets())
    except ValueError as error:
        raise SimulationError(f"MuJoCo cannot compile the world of {settings.name}: {error}") from error
    return Scene(
        model=model,
        contacts=contacts,
        object_body=model.body(OBJECT).id,
        object_geoms=np.array([model.geom(f"part_{part}").id for part in range(len(rigid_object.parts))]),
        tip_geoms=np.array([model.geom(f"tip_{finger}").id for finger in range(len(contacts))]),
        tip_radius=radius,
    )


def _compose(
    rigid_object: RigidObject, contacts: Contacts, settings: BenchSettings, radius: float, paired: np.ndarray
) -> mjcf.RootElement:
    root = mjcf.RootElement(model="bench")
    for option in ("timestep", "integrator", "cone", "jacobian", "solver", "iterations", "tolerance", "impratio"):
        setattr(root.option, option, getattr(settings, option))
    root.option.noslip_iterations = settings.noslip_iterations
    root.option.flag.set_attributes(gravity="disable", autoreset="disable")
    body = root.worldbody.add("body", name=OBJECT)
    body.add("freejoint")
    inertia = rigid_object.inertia * (settings.object_mass / rigid_object.mass)
    body.add(
        "inertial",
        pos=rigid_object.center_of_mass,
        mass=settings.object_mass,
        fullinertia=inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]],
    )
    geoms = [add_part(body, f"part_{index}", part, REAL) for index, part in enumerate(rigid_object.parts)]
    centers = contacts.points - radius * contacts.normals
    for finger, center in enumerate(centers):
        _add_fingertip(root, list(compress(geoms, paired[finger])), f"tip_{finger}", center, radius, settings)
    return root


def _add_fingertip(
    root: mjcf.RootElement,
    geoms: list[mjcf.Element],
    name: str,
    center: np.ndarray,
    radius: float,
    settings: BenchSettings,
) -> None:
    """A sphere that slides but does not turn and collides with the object only."""
    body = root.worldbody.add("body", pos=center)
    for axis in np.eye(3):
        body.add("joint", type="slide", axis=axis)
    tip = body.add("geom", name=name, type="sphere", size=[radius], mass=settings.tip_mass, contype=0, conaffinity=0)
    for geom in geoms:
        root.contact.add(
            "pair",
            geom1=tip,
            geom2=geom,
            condim=settings.condim,
            friction=[settings.friction, settings.friction, settings.torsional_friction, 0, 0],
            solref=settings.solref,
            solimp=settings.solimp,
            margin=0,
            gap=0,
        )
    root.sensor.add("contact", name=name, geom1=tip, data=" ".join(SENSOR), num=1, reduce="maxforce")
