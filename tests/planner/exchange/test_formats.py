"""Exports read back the way the other tool reads them; what a format cannot say is refused, not invented."""

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.arrays import Floats
from planner.commands.convert import Options
from planner.errors import GraspFileError
from planner.exchange.formats import FORMATS
from planner.exchange.restricted_pickle import read_pickled_dictionary
from planner.exchange.yaml_text import yaml_text
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import write_grasp
from tests.tools.commands import run, says
from tests.tools.tiny_yaml import read_yaml

HALF = np.sqrt(0.5)


def turned(quaternion: Floats) -> Floats:
    """Rotation matrix of a quaternion w, x, y, z, by its textbook formula."""
    w, x, y, z = quaternion
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * skew + 2 * skew @ skew


def isaac_gripper_pose(entry: dict[str, Any], object_turn: Floats, object_at: Floats) -> tuple[Any, Any]:
    """What Isaac Sim's GraspSpec.compute_gripper_pose_from_rigid_body_pose makes of an entry."""
    turn = turned(np.array([entry["orientation"]["w"], *entry["orientation"]["xyz"]]))
    return object_at + object_turn @ np.array(entry["position"]), object_turn @ turn


def test_isaac_sim_finds_every_contact_frame_where_the_object_carries_it(
    golden_grasp: Grasp, golden_file: Path, tmp_path: Path
) -> None:
    out = tmp_path / "prism.isaac.yaml"
    assert run("grasp-convert", golden_file, "--out", out) == 0
    document = read_yaml(out.read_text())
    assert document["format"] == "isaac_grasp"
    assert abs(document["format_version"] - 1.0) < 1e-10  # the importer's own test
    object_turn, object_at = turned(np.array([HALF, 0, HALF, 0])), np.array([0.1, -0.2, 0.3])
    assert list(document["grasps"]) == ["finger_1", "finger_2", "finger_3"]
    for finger, entry in enumerate(document["grasps"].values()):
        position, turn = isaac_gripper_pose(entry, object_turn, object_at)
        np.testing.assert_allclose(position, object_at + object_turn @ golden_grasp.contacts.points[finger])
        np.testing.assert_allclose(turn[:, 0], object_turn @ golden_grasp.contacts.normals[finger], atol=1e-12)
        assert np.linalg.det(turn) == pytest.approx(1)
        assert entry["cspace_position"] == entry["pregrasp_cspace_position"] == {}
        assert 0.999 < entry["confidence"] <= 1
    ours = document["rhograsp"]
    forces = np.array([finger["force"] for finger in ours["fingers"].values()])
    np.testing.assert_allclose(forces.sum(axis=0), -np.array(ours["wrench"][:3]), atol=1e-6)
    assert "not alternatives" in ours["note"]


def test_isaac_files_tell_the_strength_of_a_finger_that_is_not_1(limited_grasp: Grasp, tmp_path: Path) -> None:
    path, out = tmp_path / "limited.grasp.json", tmp_path / "limited.isaac.yaml"
    write_grasp(path, limited_grasp)
    assert run("grasp-convert", path, "--out", out) == 0
    fingers = read_yaml(out.read_text())["rhograsp"]["fingers"]
    assert [finger.get("strength") for finger in fingers.values()] == [None, None, 0.5]


def test_isaac_files_tell_torsion_and_torque_of_soft_fingers_alone(
    golden_file: Path, soft_grasp: Grasp, tmp_path: Path
) -> None:
    path, out = tmp_path / "box.grasp.json", tmp_path / "box.isaac.yaml"
    write_grasp(path, soft_grasp)
    assert run("grasp-convert", path, "--out", out) == 0
    ours = read_yaml(out.read_text())["rhograsp"]
    fingers, contacts = list(ours["fingers"].values()), soft_grasp.contacts
    assert [finger["torsion"] for finger in fingers] == pytest.approx(contacts.torsions.tolist())
    forces = np.array([finger["force"] for finger in fingers])
    moments = np.cross(contacts.points - np.array(ours["reference_point"]), forces).sum(axis=0)
    twists = np.array([finger["torque"] for finger in fingers]) @ contacts.normals
    np.testing.assert_allclose(moments + twists, -np.array(ours["wrench"][3:]), atol=1e-8)
    assert np.linalg.norm(twists) > 1e-4  # so torques that are lost would be seen
    assert run("grasp-convert", golden_file, "--out", out) == 0
    assert not {"torsion", "torque"} & set(read_yaml(out.read_text())["rhograsp"]["fingers"]["finger_1"])


STRANGE: Any = {'na"me: \\ #\n\u2028é': {"small": 1e-05, "list": [1e-300, -2.5e22, 3], "no": "1e5", "empty": {}}}


def test_yaml_strings_and_small_numbers_survive() -> None:
    assert read_yaml(yaml_text(STRANGE)) == STRANGE


def test_pyyaml_reads_the_same() -> None:
    yaml = pytest.importorskip("yaml", reason="PyYAML is not installed; the test's own reader stands in")
    assert yaml.safe_load(yaml_text(STRANGE)) == STRANGE


@pytest.mark.parametrize(("ending", "reason"), [(".graspgen.json", "together"), (".npy", "without a hand")])
def test_formats_of_hands_refuse_fingertips_and_say_why(
    ending: str, reason: str, golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / f"x{ending}"
    assert run("grasp-convert", golden_file, "--out", out) == 1
    assert says(capsys.readouterr().err, f"^error: .*{reason}.*Write .isaac.yaml instead")
    assert not out.exists()


def test_the_help_names_every_ending() -> None:
    for format in FORMATS:
        assert format.ending in (Options.__doc__ or "")


def hand_file(path: Path, **changes: Any) -> Path:
    """A grasp as DexGraspBench writes it: the object is turned by 90 degrees about z and moved."""
    record = {
        "obj_path": "assets/object/core_bottle",
        "obj_scale": np.float32(0.08),
        "obj_pose": np.array([1.0, 2.0, 3.0, HALF, 0, 0, HALF]),
        "grasp_qpos": np.array([1.0, 2.5, 3.0, HALF, 0, 0, HALF, 0.1, 0.2]),
        "pregrasp_qpos": np.array([1.0, 2.5, 3.0, HALF, 0, 0, HALF, 0.0, 0.0]),
        "squeeze_qpos": np.array([1.0, 2.5, 3.0, HALF, 0, 0, HALF, 0.2, 0.3]),
    }
    np.save(path, record | changes)  # type: ignore[arg-type]  # the tool saves a dictionary so
    return path


def test_a_hand_of_dexgraspbench_reaches_isaac_sim_and_graspgen(tmp_path: Path) -> None:
    out = tmp_path / "hand.isaac.yaml"
    assert run("grasp-convert", hand_file(tmp_path / "a.npy", joint_names=["thumb", "index"]), "--out", out) == 0
    entry = read_yaml(out.read_text())["grasps"]["grasp_0"]
    np.testing.assert_allclose(entry["position"], [0.5, 0, 0], atol=1e-12)
    assert abs(entry["orientation"]["w"]) == pytest.approx(1)
    assert entry["cspace_position"] == {"thumb": 0.1, "index": 0.2}
    assert run("grasp-convert", hand_file(tmp_path / "b.npy"), "--out", out) == 0
    document = read_yaml(out.read_text())
    assert document["grasps"]["grasp_0"]["cspace_position"] == {}
    assert document["rhograsp"]["joints"] == [0.1, 0.2]

    out = tmp_path / "hand.graspgen.json"
    assert run("grasp-convert", hand_file(tmp_path / "c.npy", succ_flag=np.True_), "--out", out) == 0
    grasps = json.loads(out.read_text())["grasps"]  # as GraspGen reads it
    poses = np.array(grasps["transforms"])[np.array(grasps["object_in_gripper"], dtype=bool)]
    expected = np.eye(4)
    expected[0, 3] = 0.5
    np.testing.assert_allclose(poses, [expected], atol=1e-12)


def test_graspgen_gets_no_outcome_that_nobody_has_seen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("grasp-convert", hand_file(tmp_path / "a.npy"), "--out", tmp_path / "x.graspgen.json") == 1
    assert says(capsys.readouterr().err, "succ_flag")
    assert run("grasp-convert", hand_file(tmp_path / "a.npy"), "--out", tmp_path / "x.glb") == 1
    assert says(capsys.readouterr().err, "grasp of a hand")


class Malicious:
    """Creates a file when it is unpickled without restraint."""

    def __init__(self, victim: Path) -> None:
        self._victim = victim

    def __reduce__(self) -> tuple[Any, ...]:
        return Path.touch, (self._victim,)


def test_a_malicious_pickle_does_not_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    victim = tmp_path / "victim"
    evil = hand_file(tmp_path / "evil.npy", obj_path=Malicious(victim))
    assert run("grasp-convert", evil, "--out", tmp_path / "x.isaac.yaml") == 1
    assert says(capsys.readouterr().err, "^error: .*only NumPy arrays are read")
    assert not victim.exists()
    np.load(evil, allow_pickle=True)
    assert victim.exists()  # so the file was as bad as it claims


def test_broken_or_foreign_npy_files_are_refused(tmp_path: Path) -> None:
    good = hand_file(tmp_path / "good.npy").read_bytes()
    np.save(tmp_path / "plain.npy", np.zeros(3))
    (tmp_path / "cut.npy").write_bytes(good[:-40])
    (tmp_path / "text.npy").write_text("no array")
    (tmp_path / "greedy.npy").write_bytes(good[:128] + pickle.dumps(np.zeros(3))[:-1] + b"\x8b\xff\xff\xff\x7f.")
    for name, message in (
        ("plain", "float64"), ("cut", "safely"), ("text", "safely"), ("greedy", "safely"), ("none", "cannot be read"),
    ):  # fmt: skip
        with pytest.raises(GraspFileError, match=message):
            read_pickled_dictionary(tmp_path / f"{name}.npy")
