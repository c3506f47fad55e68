"""The composed scene is the object MuJoCo compiles from its own file: every ray stops at the same place."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from sim.scene.fingertips import Fingertips
from sim.scene.object_joints import FreeJoint
from sim.scene.scene import Scene, build_scene
from sim.scene.units import Units, units_of
from sim.trial.experiment import floating_object
from sim.trial.protocol import ACTIVE
from tests.tools.lanes import first_fast
from tests.tools.movable_geom import body_id

ASSETS = Path(__file__).resolve().parents[3] / "assets"
SHARED = Path(__file__).resolve().parents[4] / "shared" / "objects"
OBJECTS = {
    "box": ASSETS / "box" / "box.xml",
    "bracket": ASSETS / "bracket" / "bracket.xml",
    "cylinder": ASSETS / "cylinder" / "cylinder.xml",
    "ellipsoid": ASSETS / "ellipsoid" / "ellipsoid.xml",
    "mug": ASSETS / "mug" / "mug.xml",
    "prism": ASSETS / "prism" / "prism.xml",
    "hammer on two bodies": SHARED / "metaworld_hammer" / "objects" / "hammer.xml",
    "mug with a handle body": SHARED / "mujoco_mug" / "mug.xml",
}
DRILL = SHARED / "ycb_power_drill" / "power_drill.xml"
"""Its 33 meshes are not quite convex: rays stop at the meshes, contacts at their hulls."""
RAYS = 400


@pytest.mark.parametrize("name", first_fast(OBJECTS, fast=2))
def test_rays_meet_the_composed_scene_where_they_meet_the_original_model(name: str) -> None:
    if not OBJECTS[name].is_file():
        pytest.skip(f"{OBJECTS[name].name} is one of the shared objects, which are not here")
    rigid_object = read_object(OBJECTS[name])
    scene, units = scene_of(rigid_object)
    origins, directions = rays(rigid_object)
    original = original_distances(rigid_object, origins, directions)
    composed = distances(scene.model, units.points(origins), directions, scene.object_body) / units.length
    assert (original > 0).mean() > 0.3
    np.testing.assert_allclose(composed[original > 0], original[original > 0], atol=1e-5 * rigid_object.size)


@pytest.mark.skipif(not DRILL.is_file(), reason="the drill is one of the shared objects, which are not here")
def test_a_fingertip_is_as_far_from_the_composed_scene_as_from_the_original_model() -> None:
    drill = read_object(DRILL)
    scene, units = scene_of(drill)
    centers = rays(drill)[0][:40]
    radius = scene.tip_radius / units.length
    original = [original_gap(drill, center, radius) for center in centers]
    composed = [gap(scene, units.points(center)) / units.length for center in centers]
    np.testing.assert_allclose(composed, original, atol=1e-5 * drill.size)


def gap(scene: Scene, center: Floats) -> float:
    """Distance of the first fingertip, moved to `center`, from the object."""
    data = mujoco.MjData(scene.model)
    tip = scene.tip_geoms[0]
    mujoco.mj_forward(scene.model, data)
    data.qpos[scene.joints.positions :][:3] = center - data.geom_xpos[tip]
    mujoco.mj_forward(scene.model, data)
    return min(mujoco.mj_geomDistance(scene.model, data, tip, part, 1.0, None) for part in scene.object_geoms)


def original_gap(rigid_object: RigidObject, center: Floats, radius: float) -> float:
    """The same with a sphere added to the object's own file."""
    spec = mujoco.MjSpec.from_file(str(rigid_object.file))
    body = spec.body(rigid_object.body)
    body.add_geom(name="probe", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0, 0], pos=center, mass=1e-3)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    probe = model.geom("probe").id
    collides = (model.geom_contype | model.geom_conaffinity) != 0
    collides[probe] = False
    return min(mujoco.mj_geomDistance(model, data, probe, geom, 1.0, None) for geom in np.flatnonzero(collides))


def scene_of(rigid_object: RigidObject) -> tuple[Scene, Units]:
    """A scene with two fingers somewhere far away."""
    points = rigid_object.center_of_mass + rigid_object.size * np.array([(-3.0, 0, 0), (3.0, 0, 0)])
    contacts = Contacts(points=points, normals=np.array([(1.0, 0, 0), (-1.0, 0, 0)]), friction=np.full(2, 0.5))
    units = units_of(contacts, rigid_object.center_of_mass, rho=1.0, reach=ACTIVE.reach)
    tips = Fingertips(contacts=units.contacts(contacts), radius=0.04 * ACTIVE.reach, mass=ACTIVE.tip_mass)
    return build_scene(floating_object(rigid_object.parts, units, ACTIVE, FreeJoint()), tips, ACTIVE), units


def rays(rigid_object: RigidObject) -> tuple[Floats, Floats]:
    """Rays from a sphere about the object towards points of its bounding box, in the body frame."""
    rng = np.random.default_rng(0)
    outward = rng.normal(size=(RAYS, 3))
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    corners = np.concatenate([part.triangles()[0].reshape(-1, 3) for part in rigid_object.parts])
    low, high = corners.min(axis=0), corners.max(axis=0)
    origins = (low + high) / 2 + rigid_object.size * outward
    directions = rng.uniform(low, high, size=(RAYS, 3)) - origins
    return origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)


def original_distances(rigid_object: RigidObject, origins: Floats, directions: Floats) -> Floats:
    """Distances in the model compiled from the object's own file, visual geoms and planes left out."""
    model = mujoco.MjModel.from_xml_path(str(rigid_object.file))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    body = body_id(model, rigid_object.body)
    X, R = data.xpos[body], data.xmat[body].reshape(3, 3)
    return distances(model, X + origins @ R.T, directions @ R.T, body)


def distances(model: mujoco.MjModel, origins: Floats, directions: Floats, body: int) -> Floats:
    """Where rays meet geoms that can collide; -1 for a miss."""
    collides = (model.geom_contype | model.geom_conaffinity) != 0
    wanted = collides & (model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE)
    if not wanted.any():  # the composed scene lists its contacts pair by pair
        wanted = model.geom_bodyid == body
    model.geom_group[:] = np.where(wanted, 0, 5)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    shown = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)
    hit = np.zeros(1, dtype=np.int32)
    return np.array(
        [
            mujoco.mj_ray(model, data, origin, direction, shown, 1, -1, hit)
            for origin, direction in zip(origins, directions, strict=True)
        ]
    )
