"""A small sphere put against an object in MuJoCo: the oracle for contact points and normals."""

from pathlib import Path

import mujoco
import numpy as np

from planner.arrays import Floats
from planner.candidates.candidates import Candidates
from planner.objects.rigid_object import RigidObject
from tests.tools.movable_geom import MovableGeom

RADIUS, GAP = 2e-3, 1e-3
"""Of the sphere and above the surface, relative to the object's size."""


class Fingertip:
    """The object's own file with one more, movable sphere in the world."""

    def __init__(self, path: Path, thing: RigidObject) -> None:
        self.radius, self.gap = RADIUS * thing.size, GAP * thing.size
        self.tip = MovableGeom(path, thing, mujoco.mjtGeom.mjGEOM_SPHERE, (self.radius,))

    def measure(self, candidates: Candidates, index: int) -> tuple[float, Floats]:
        """Height of a candidate above the surface [m] and the direction from the tip to it, as MuJoCo sees them."""
        point, normal = candidates.contacts.points[index], candidates.contacts.normals[index]
        self.tip.put(point - (self.radius + self.gap) * normal, normal)
        gap, way = self.tip.to_part(int(candidates.part[index]))
        return gap - self.gap, way / np.linalg.norm(way)
