"""A capsule put beside an object in MuJoCo: the oracle for a fingertip's way."""

from pathlib import Path

import mujoco

from planner.arrays import Floats
from planner.objects.rigid_object import RigidObject
from tests.tools.movable_geom import MovableGeom


class Capsule:
    """The object's own file with one more geom, put where the ball of a radius goes from one point to another."""

    def __init__(self, path: Path, thing: RigidObject, radius: float, length: float) -> None:
        self.way = MovableGeom(path, thing, mujoco.mjtGeom.mjGEOM_CAPSULE, (radius, length / 2))

    def least_distance(self, start: Floats, end: Floats, but: int) -> float:
        """Distance of the capsule from all parts but one, negative where it enters one [m]."""
        self.way.put((start + end) / 2, end - start)
        others = [part for part in range(len(self.way.parts)) if part != but]
        return min(self.way.to_part(part)[0] for part in others)
