"""A geom put beside an object in MuJoCo: what the oracles of contacts measure with."""

from pathlib import Path

import mujoco
import numpy as np

from planner.arrays import Floats
from planner.objects.rigid_object import RigidObject

NAME = "movable"
FAR = 10.0
"""Distances are not measured beyond this [m]."""


class MovableGeom:
    """The object's own file with one more geom in the world; points and directions in the object's body frame B."""

    def __init__(self, path: Path, thing: RigidObject, kind: mujoco.mjtGeom, size: tuple[float, ...]) -> None:
        spec = mujoco.MjSpec.from_file(str(path))
        body = spec.worldbody.add_body(name=NAME, mocap=True)
        body.add_geom(name=NAME, type=kind, size=[*size, 0, 0][:3])
        spec.option.ccd_tolerance = 1e-10
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, self.data)
        root = body_id(self.model, thing.body)
        self.rotation, self.origin = self.data.xmat[root].reshape(3, 3).copy(), self.data.xpos[root].copy()
        self.parts = [_id(self.model, mujoco.mjtObj.mjOBJ_GEOM, "geom", part.geom) for part in thing.parts]

    def put(self, center: Floats, axis: Floats) -> None:
        """Its middle at a point, its z axis along a direction."""
        self.data.mocap_pos[0] = self.origin + self.rotation @ center
        mujoco.mju_quatZ2Vec(self.data.mocap_quat[0], self.rotation @ axis)
        mujoco.mj_kinematics(self.model, self.data)

    def to_part(self, part: int) -> tuple[float, Floats]:
        """Distance from a part, negative inside [m], and the way from the geom to it, shape (3,) [m]."""
        ends = np.zeros(6)
        geom = self.model.geom(NAME).id
        distance = mujoco.mj_geomDistance(self.model, self.data, geom, self.parts[part], FAR, ends)
        return distance, self.rotation.T @ (ends[3:] - ends[:3])


def body_id(model: mujoco.MjModel, name: str) -> int:
    """A body by the name that the planner gives it: `body<id>` where it has none."""
    return _id(model, mujoco.mjtObj.mjOBJ_BODY, "body", name)


def _id(model: mujoco.MjModel, kind: mujoco.mjtObj, prefix: str, name: str) -> int:
    named = mujoco.mj_name2id(model, kind, name)
    return int(named) if named >= 0 else int(name.removeprefix(prefix))
