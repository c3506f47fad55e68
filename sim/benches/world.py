"""The world of another group's test: the object as heavy as they make it, fingertips in place of their hand.

In real units; axes and origin are those of the body frame B at the start. External forces act at the object's true
centre of mass.
"""

from dataclasses import replace

import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.objects.rigid_object import RigidObject
from sim.benches.settings import BenchSettings
from sim.scene.fingertips import Fingertips
from sim.scene.floating_object import FloatingObject
from sim.scene.placement import placed_scene
from sim.scene.scene import Scene
from sim.scene.units import Units

REAL = Units(reference_point=np.zeros(3), length=1.0, force=1.0)
"""Real metres and newtons, body frame."""


def build_world(rigid_object: RigidObject, contacts: Contacts, settings: BenchSettings) -> Scene:
    """The scene with the largest fingertips that touch only where planned.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp in the body frame; neither its friction nor its torsional friction is used.
        settings: The test.

    Raises:
        SimulationError: When MuJoCo cannot compile the world, or a fingertip is not where it was planned.
    """
    if contacts.dimension != 3:
        raise SimulationError("only grasps in space can be simulated; this one is planar")
    reach = float(np.linalg.norm(contacts.points - rigid_object.center_of_mass, axis=1).max(initial=0))
    if not reach > 0:
        raise SimulationError("no contact away from the centre of mass: nothing to hold the object with")
    held = FloatingObject(
        parts=rigid_object.parts,
        units=REAL,
        mass=settings.object_mass,
        center_of_mass=rigid_object.center_of_mass,
        inertia=rigid_object.inertia * (settings.object_mass / rigid_object.mass),
    )
    friction, torsion = np.repeat([[settings.friction], [settings.torsional_friction]], len(contacts), axis=1)
    tested = replace(contacts, friction=friction, torsion=torsion)
    tips = Fingertips(contacts=tested, radius=0.0, mass=settings.tip_mass)
    radii = [radius * reach for radius in settings.tip_radii]
    scene, static = placed_scene(held, tips, settings, radii, rigid_object.size)
    if static.reasons():
        raise SimulationError("; ".join(static.reasons()))
    return scene
