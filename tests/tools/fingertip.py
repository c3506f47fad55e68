"""A small sphere put against an object in MuJoCo: the oracle for contact points and normals."""

from pathlib import Path

import mujoco
import numpy as np

from planner.arrays import Floats
from planner.candidates.candidates import Candidates
from planner.objects.rigid_object import RigidObject

RADIUS, GAP = 2e-3, 1e-3
"""Of the sphere and above the surface, relative to the object's size."""


class Fingertip:
    """The object's own file with one more, movable sphere in the world."""

    def __init__(self, path: Path, thing: RigidObject) -> None:
        spec = mujoco.MjSpec.from_file(str(path))
        tip = spec.worldbody.add_body(name="tip", mocap=True)
        self.radius, self.gap = RADIUS * thing.size, GAP * thing.size
        tip.add_geom(name="tip", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[self.radius, 0, 0])
        spec.option.ccd_tolerance = 1e-10
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        named = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, thing.body)
        body = named if named >= 0 else int(thing.body.removeprefix("body"))
        self.rotation, self.origin = self.data.xmat[body].reshape(3, 3).copy(), self.data.xpos[body].copy()
        self.geoms = [self._geom(part.geom) for part in thing.parts]

    def _geom(self, name: str) -> int:
        named = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_GEOM, name)
        return int(named) if named >= 0 else int(name.removeprefix("geom"))

    def measure(self, candidates: Candidates, index: int) -> tuple[float, Floats]:
        """Height of a candidate above the surface [m] and the direction from the tip to it, as MuJoCo sees them."""
        point, normal = candidates.contacts.points[index], candidates.contacts.normals[index]
        away = point - (self.radius + self.gap) * normal
        self.data.mocap_pos[0] = self.origin + self.rotation @ away
        mujoco.mj_kinematics(self.model, self.data)
        between = np.zeros(6)
        tip = self.model.geom("tip").id
        geom = self.geoms[candidates.part[index]]
        gap = mujoco.mj_geomDistance(self.model, self.data, tip, geom, 1.0, between)
        direction = self.rotation.T @ (between[3:] - between[:3])
        return gap - self.gap, direction / np.linalg.norm(direction)
