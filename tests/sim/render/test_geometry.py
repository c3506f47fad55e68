"""Rays, outlines and cameras, against MuJoCo and against counting."""

import mujoco
import numpy as np

from planner.contacts import Contacts
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.rays import ray_hits
from sim.render.outline import visible_edges
from sim.render.recording import Recording
from sim.render.sight import exit_distance, open_to
from sim.render.view import View, best_direction
from tests.strategies.parts import box, rigid_object


def test_rays_meet_the_object_where_mujoco_says(prism: RigidObject, recording: Recording) -> None:
    scene, units = recording.experiment.scene, recording.experiment.units
    triangles = units.points(prism.parts[0].triangles()[0])
    data = mujoco.MjData(scene.model)
    mujoco.mj_forward(scene.model, data)
    generator = np.random.default_rng(0)
    origins = generator.normal(scale=0.3, size=(60, 3))
    directions = generator.normal(scale=0.03, size=(60, 3)) - origins
    hits = ray_hits(triangles, origins[:, None], directions[:, None])
    ours = np.where(hits > 0, hits, np.inf).min(axis=1)
    geom = np.zeros(1, dtype=np.int32)
    compared = 0
    for origin, direction, distance in zip(origins, directions, ours, strict=True):
        theirs = mujoco.mj_ray(scene.model, data, origin, direction, None, True, -1, geom)
        if geom[0] in scene.tip_geoms:
            continue
        compared += theirs > 0
        np.testing.assert_allclose(distance, theirs if theirs > 0 else np.inf, rtol=1e-6)
    assert compared > 20


def test_a_line_leaves_the_object_where_it_ends() -> None:
    triangles, _ = box((0.1, 0.2, 0.3)).triangles()
    up = np.array([0.0, 0.0, 1.0])
    assert abs(exit_distance(triangles, np.zeros(3), up) - 0.3) < 1e-12
    assert exit_distance(triangles, np.array([1.0, 0, 0]), up) == 0
    points = np.array([[0.0, 0.0, 0.31], [0.0, 0.0, -0.31], [0.3, 0.0, -0.31]])
    assert open_to(triangles, points, up).tolist() == [True, False, True]


def test_flush_parts_have_no_edge_where_they_meet_and_creases_keep_theirs() -> None:
    """Two boxes in a row: of 24 edges the 8 around the seam vanish, or half of them turn into edges of a step."""
    first = box((0.1, 0.1, 0.1))
    assert len(visible_edges(rigid_object(first))) == 12
    assert len(visible_edges(rigid_object(first, box((0.1, 0.1, 0.1), (0.2, 0, 0))))) == 24 - 8
    step = visible_edges(rigid_object(first, box((0.1, 0.1, 0.15), (0.2, 0, 0.05))))
    heights = np.round(step[np.isclose(step[..., 0], 0.1).all(axis=1)][:, :, 2], 9)
    assert sorted({height for pair in heights.tolist() for height in pair}) == [0.1, 0.2]


def test_everything_to_be_shown_just_fits() -> None:
    points = np.random.default_rng(1).normal(size=(200, 3)) * [1.0, 2.0, 0.3]
    for width, height in ((400, 300), (300, 400)):
        view = View(azimuth=40.0, elevation=30.0, target=np.zeros(3), distance=1.0).fitted(points, width / height)
        pixels = view.pixels(points, width, height)
        lower, upper = pixels.min(axis=0), pixels.max(axis=0)
        assert (lower > 0).all() and (upper < [width, height]).all()
        assert (np.ptp(pixels, axis=0) / [width, height]).max() > 0.9
        np.testing.assert_allclose((lower + upper) / 2, [width / 2, height / 2], atol=3)


def test_the_camera_is_mujocos_own(recording: Recording) -> None:
    """Our projection, against the camera that MuJoCo derives from the same angles."""
    view = View(azimuth=152.0, elevation=42.0, target=np.array([0.01, 0.02, 0.03]), distance=0.4)
    model = recording.experiment.scene.model
    data, scene = mujoco.MjData(model), mujoco.MjvScene(model, 100)
    mujoco.mj_forward(model, data)
    mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), None, view.camera(), mujoco.mjtCatBit.mjCAT_ALL, scene)
    position, forward, up = np.zeros(3), np.zeros(3), np.zeros(3)
    mujoco.mjv_cameraInModel(position, forward, up, scene)
    np.testing.assert_allclose(view.target + view.distance * view.axes[2], position, atol=1e-6)
    np.testing.assert_allclose(view.axes[2], -forward, atol=1e-6)
    np.testing.assert_allclose(view.axes[1], up, atol=1e-6)


def test_contacts_on_one_side_are_looked_at_from_that_side() -> None:
    triangles, _ = box((0.1, 0.1, 0.1)).triangles()
    for side in (np.array([1.0, 0, 0]), np.array([0, -1.0, 0])):
        contacts = Contacts(points=0.1 * side[None], normals=-side[None], friction=np.ones(1))
        azimuth, elevation = best_direction(triangles, contacts)
        back = View(azimuth=azimuth, elevation=elevation, target=np.zeros(3), distance=1.0).axes[2]
        assert back @ side > 0
        assert back[2] > 0.3
