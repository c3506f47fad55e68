"""Enlarged motion tells no lies: true at a factor of one, and a hold never looks like a loss."""

from dataclasses import replace

import numpy as np
import pytest

from planner.objects.rigid_object import RigidObject
from sim.render.drawn_motion import AVERAGED, drawn_pose, motion_factor
from sim.render.recording import Recording


def test_motion_that_is_not_enlarged_is_where_the_simulation_had_it(recording: Recording) -> None:
    scene, step = recording.experiment.scene, 400
    pose = drawn_pose(recording, step, 1, 1.0)
    coordinates = recording.coordinates[step, 1]
    anchors = scene.contacts.points - scene.tip_radius * scene.contacts.normals
    np.testing.assert_allclose(pose.position, coordinates[:3], atol=1e-15)
    np.testing.assert_allclose(pose.tips, anchors + coordinates[7:].reshape(-1, 3), atol=1e-12)
    forces = [recording.forces(past, 1) for past in range(step - AVERAGED + 1, step + 1)]
    np.testing.assert_allclose(pose.forces, np.mean(forces, axis=0), atol=1e-12)


def test_enlarged_motion_is_so_many_times_larger(recording: Recording) -> None:
    true, drawn = (drawn_pose(recording, 549, 1, factor) for factor in (1.0, 3.0))
    np.testing.assert_allclose(drawn.position, 3 * true.position)
    angles = [np.arccos((np.trace(pose.rotation) - 1) / 2) for pose in (true, drawn)]
    assert angles[1] == pytest.approx(3 * angles[0])
    slips = [(pose.tips - pose.position) @ pose.rotation for pose in (true, drawn)]
    planned = drawn_pose(recording, 0, 1, 1.0).tips
    np.testing.assert_allclose(slips[1] - planned, 3 * (slips[0] - planned), atol=1e-12)


def test_forces_keep_their_angle_to_the_cone_however_far_the_object_is_drawn(recording: Recording) -> None:
    angles = [
        (pose.forces * pose.normals).sum(axis=1) / np.linalg.norm(pose.forces, axis=1)
        for pose in (drawn_pose(recording, 549, 1, factor) for factor in (1.0, 5.0))
    ]
    np.testing.assert_allclose(angles[0], angles[1], atol=1e-12)
    assert (angles[0] > np.cos(np.arctan(0.301))).all()  # inside the cones of friction 0.3


def farthest(prism: RigidObject, recording: Recording, simulation: int, factor: float) -> float:
    """How far the object's outermost corner is drawn from where it was planned, relative to the object's size."""
    units = recording.experiment.units
    corners = units.points(prism.parts[0].triangles()[0].reshape(-1, 3))
    pose = drawn_pose(recording, 549, simulation, factor)
    moved = corners @ pose.rotation.T + pose.position - corners
    return float(np.linalg.norm(moved, axis=1).max()) / (prism.size * units.length)


def test_a_loss_is_made_visible_and_a_hold_is_not(prism: RigidObject, recording: Recording) -> None:
    """A loss is drawn with about a tenth of the object's size, a hold with less than a thousandth."""
    factor = motion_factor(recording, prism)
    assert farthest(prism, recording, 1, 1.0) < 0.03
    assert 0.05 < farthest(prism, recording, 1, factor) < 0.12
    both_held = replace(recording, coordinates=recording.coordinates[:, [0, 0]])
    assert motion_factor(both_held, prism) > factor
    assert farthest(prism, both_held, 0, motion_factor(both_held, prism)) < 1e-3


def test_no_fingertip_is_drawn_inside_the_object(prism: RigidObject, recording: Recording) -> None:
    """A tip that gave way inward is not enlarged into the object."""
    coordinates = recording.coordinates.copy()
    scene = recording.experiment.scene
    coordinates[:, 1, :7] = coordinates[:, 0, :7]
    coordinates[:, 1, 7:] = (0.5 * scene.tip_radius * scene.contacts.normals).ravel()
    assert motion_factor(replace(recording, coordinates=coordinates), prism) == 1
