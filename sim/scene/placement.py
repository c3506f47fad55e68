"""Fingertips as large as they can be without touching anything but what was planned."""

from collections.abc import Sequence
from dataclasses import replace

from planner.objects.mjcf.touch import TIP
from sim.scene.fingertips import Fingertips
from sim.scene.floating_object import FloatingObject
from sim.scene.physics import Physics
from sim.scene.scene import Scene, build_scene
from sim.scene.static_check import StaticCheck, check_touch


def placed_scene(
    held: FloatingObject, tips: Fingertips, physics: Physics, radii: Sequence[float], size: float
) -> tuple[Scene, StaticCheck]:
    """The scene with the largest fingertips that touch only where planned; if none do, the check says which.

    The smallest ones tried are those with which the planner confirms its candidates.

    Args:
        held: The object.
        tips: The fingertips, their radius aside.
        physics: Settings.
        radii: Radii to try, in the units of the scene [m].
        size: Of the object, in the user's units [m].

    Raises:
        SimulationError: When MuJoCo cannot compile the scene.
    """
    length = held.units.length
    for radius in sorted((*radii, TIP * size * length), reverse=True):
        tips = replace(tips, radius=radius)
        scene = build_scene(held, tips, physics)
        static = check_touch(scene, size, length)
        if not static.reasons():
            break
    if static.spared.any():
        scene = build_scene(held, replace(tips, spared=static.spared), physics)
    return scene, static
