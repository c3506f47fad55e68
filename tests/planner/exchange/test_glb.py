"""The exported scene shows the object where it is and forces as long as they are strong."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from planner.errors import GraspFileError
from planner.exchange.glb import FORCE_LENGTH, write_glb
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
