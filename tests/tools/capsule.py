"""A capsule put beside an object in MuJoCo: the oracle for a fingertip's way."""

from pathlib import Path

import mujoco

from planner.arrays import Floats
from planner.objects.rigid_object import RigidObject


class Capsule:
    """The object's own file with one more geom, put where the ball of a radius goes from one point to another."""

    def __init__(self, path: Path, thing: RigidObject, radius: float, length: float) -> None:
        spec = mujoco.MjSpec.from_file(str(path))
        body = spec.worldbody.add_body(name="way", mocap=True)
        body.add_geom(name="way", type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=[radius, length / 2, 0])
        spec.option.ccd_tolerance = 1e-10
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, self.data)
        named = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, thing.body)
        root = named if named >= 0 else int(thing.body.removeprefix("body"))
        self.rotation, self.origin = self.data.xmat[root].reshape(3, 3).copy(), self.data.xpos[root].copy()
        self.geoms = [self._geom(part.geom) for part in thing.parts]

    def _geom(self, name: str) -> int:
        named = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_GEOM, name)
        return int(named) if named >= 0 else int(name.removeprefix("geom"))

    def least_distance(self, start: Floats, end: Floats, but: int) -> float:
        """Distance of the capsule from all parts but one, negative where it enters one [m]."""
        self.data.mocap_pos[0] = self.origin + self.rotation @ (start + end) / 2
        mujoco.mju_quatZ2Vec(self.data.mocap_quat[0], self.rotation @ (end - start))
        mujoco.mj_kinematics(self.model, self.data)
        way = self.model.geom("way").id
        others = [geom for part, geom in enumerate(self.geoms) if part != but]
        return min(mujoco.mj_geomDistance(self.model, self.data, way, geom, 10.0, None) for geom in others)
