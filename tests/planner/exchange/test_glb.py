"""The exported scene shows the object where it is and forces as long as they are strong."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from planner.arrays import Floats
from planner.contacts import contact_frames
from planner.errors import GraspFileError
from planner.exchange.glb import FORCE_LENGTH, FULL_TURN, LEAST_TURN, TORQUE_AT, TORQUE_RADIUS, grasp_scene, write_glb
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from tests.tools.commands import run


def test_the_scene_is_read_back_with_object_cones_and_forces_in_place(
    prism: RigidObject, golden_grasp: Grasp, tmp_path: Path
) -> None:
    write_glb(tmp_path / "prism.glb", prism, golden_grasp)
    scene = trimesh.load_scene(tmp_path / "prism.glb")
    names = set(scene.graph.nodes_geometry)
    assert {"object/0/prism", "cone/0", "cone/2"} <= names
    body = scene.geometry["object/0/prism"]
    np.testing.assert_allclose(np.ptp(body.vertices, axis=0), prism.extent, rtol=1e-6)
    forces = golden_grasp.forces[golden_grasp.critical_wrench]
    for finger, (point, force) in enumerate(zip(golden_grasp.contacts.points, forces, strict=True)):
        arrow = scene.geometry[f"force/{finger}"].vertices
        along = arrow @ (force / np.linalg.norm(force))
        length = FORCE_LENGTH * prism.size * np.linalg.norm(force) / golden_grasp.rho
        assert along.max() - point @ force / np.linalg.norm(force) == pytest.approx(0, abs=1e-6 * prism.size)
        assert length <= np.ptp(along) <= length + 0.05 * prism.size


def test_a_torque_is_an_arc_that_turns_as_it_does_and_is_as_long_as_it_is_strong(
    box_object: RigidObject, soft_grasp: Grasp, prism: RigidObject, golden_grasp: Grasp
) -> None:
    """The largest gamma rho is an arc of FULL_TURN."""
    contacts, size, shares = soft_grasp.contacts, box_object.size, []
    for wrench in (soft_grasp.critical_wrench, int(np.abs(soft_grasp.torques).max(axis=1).argmin())):
        scene = grasp_scene(box_object, soft_grasp, wrench)
        for finger, (normal, torque) in enumerate(zip(contacts.normals, soft_grasp.torques[wrench], strict=True)):
            share = torque / (contacts.torsions[finger] * soft_grasp.rho)
            assert (f"torque/{finger}" in scene.geometry) == (abs(share) > LEAST_TURN)
            shares.append(share)
            if abs(share) < 0.05:
                continue
            arc = scene.geometry[f"torque/{finger}"].vertices - contacts.points[finger] + TORQUE_AT * size * normal
            assert np.abs(arc @ normal).max() < 0.02 * size
            assert np.linalg.norm(np.cross(arc, normal), axis=1).min() > 0.7 * TORQUE_RADIUS * size
            beyond = seen_turn(arc, np.sign(torque) * normal) - FULL_TURN * abs(share)
            assert 0.1 < beyond < 0.65  # the head is as long as 0.54 rad
    assert min(shares) < -0.5 < 0.5 < max(shares)  # so a sign that is lost would be seen
    assert np.abs(shares).min() < 0.4  # and an arc of the same length always
    hard = grasp_scene(prism, golden_grasp, golden_grasp.critical_wrench)
    assert not any(name.startswith("torque") for name in hard.geometry)


def seen_turn(vertices: Floats, axis: Floats) -> float:
    """How far an arc with its head goes round its axis from where it begins [rad]; it begins at the frame's tangent."""
    _, first, second = contact_frames(axis[None])[0].T
    angles = np.arctan2(vertices @ second, vertices @ first) % (2 * np.pi)
    return float(angles[angles < 1.9 * np.pi].max())  # without the rod's width before the beginning


def test_a_wrench_that_does_not_exist_is_refused(prism: RigidObject, golden_grasp: Grasp, tmp_path: Path) -> None:
    with pytest.raises(GraspFileError, match="wrench 64"):
        write_glb(tmp_path / "x.glb", prism, golden_grasp, wrench=64)


def test_the_command_writes_glb_and_refuses_other_endings(
    golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("grasp-convert", golden_file, "--out", tmp_path / "x.glb") == 0
    assert (tmp_path / "x.glb").read_bytes()[:4] == b"glTF"
    assert run("grasp-convert", golden_file, "--out", tmp_path / "x.stl") == 1
    assert "end in .glb" in capsys.readouterr().err
