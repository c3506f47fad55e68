"""`--body`, `--lock-joints`, `--keyframe`, `--mass` as users meet them, in every command that reads the object."""

import json
from pathlib import Path

import pytest

from planner.grasps.grasp_file import read_grasp
from planner.grasps.grasped_object import read_grasped_object
from planner.objects.rigid_object import RigidObject
from tests.strategies.cups import mesh_cup
from tests.strategies.mjcf_files import world, written
from tests.strategies.tied_bodies import BOTTLE, KEYS, MUG
from tests.tools.commands import run, says
from tests.tools.shared import shared

pytestmark = pytest.mark.slow

LIFT = "[set]\nkind = 'single'\nwrench = [0, 0, {}, 0, 0, 0]\n"

SEARCH = ("--fingers", 3, "--friction", 0.6, "--gap", 0.01)


def locked_bottle(folder: Path, body: str) -> Path:
    """A grasp of the bottle by one of its bodies, its joints frozen where the keyframe has opened them."""
    path = written(folder, world(BOTTLE).replace("</mujoco>", KEYS))
    out = folder / "bottle.grasp.json"
    assert run("grasp-plan", path, "--candidates", 40, "--out", out, "--body", body, *SEARCH) == 1
    how = ("--lock-joints", "screw", "pull", "flip", "--keyframe", "open")
    assert run("grasp-plan", path, "--candidates", 40, "--out", out, "--body", body, *SEARCH, *how) == 0
    return out


def test_what_is_planned_on_is_what_every_command_reads_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = locked_bottle(tmp_path, "cap")
    seen = capsys.readouterr()
    assert says(seen.err, r"error: .*--lock-joints screw pull flip")
    assert says(seen.out, r"locked +screw, pull, flip: .* keyframe 'open'")
    assert says(seen.out, r"touched +2 of 3 geoms, those of body 'cap'")
    grasp = read_grasp(file)
    assert grasp.rho >= 0.421 * 9.8 / 3
    assert set(grasp.geoms) <= {"lid", "loop"}
    record = json.loads(file.read_text())["object"]
    assert (record["locked_joints"], record["keyframe"]) == (["screw", "pull", "flip"], "open")
    again = read_grasped_object(grasp)
    assert isinstance(again, RigidObject)
    assert again.mass == pytest.approx(0.421)
    assert again.untouchable == {0}
    assert again.parts[0].bounds()[:, 2].mean() == pytest.approx(-0.175)
    assert run("grasp-verify", file) == 0
    assert run("grasp-validate", file, "--out", tmp_path / "v.json") == 0
    assert run("grasp-report", file, "--out", tmp_path / "r.html") == 0
    assert run("grasp-convert", file, "--out", tmp_path / "s.glb") == 0


def test_a_mug_by_its_handle_carries_the_whole_mug(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its weight alone asks each of four fingers for m g / 4; a load of the handle's own 20 g would not."""
    path = written(tmp_path, world(MUG.replace('euler="20 30 40"', "")))
    task, out = tmp_path / "lift.toml", tmp_path / "mug.grasp.json"
    how = ("--fingers", 4, "--friction", 0.6, "--candidates", 60, "--gap", 0.01)
    assert run("grasp-plan", path, "--body", "handle", *how, "--out", out) == 0
    assert read_grasp(out).rho >= 0.43 * 9.8 / 4
    task.write_text(LIFT.format(-0.43 * 9.81))
    assert run("grasp-plan", path, "--body", "handle", *how, "--task", task, "--out", out) == 0
    held = read_grasp(out)
    assert held.rho >= 0.43 * 9.8 / 4
    assert set(held.geoms) <= {"bar", "ball"}
    assert says(capsys.readouterr().out, r"body 'handle': 0.43 kg")


def test_the_shared_mug_and_bottle_need_what_their_readme_says(tmp_path: Path) -> None:
    mug, bottle = shared("cases", "mug_by_handle", "mug.xml"), shared("cases", "bottle_by_cap", "bottle.xml")
    out = tmp_path / "x.grasp.json"
    how = ("--friction", 0.6, "--gap", 0.01, "--out", out)
    assert run("grasp-plan", mug, "--body", "handle", "--fingers", 4, "--candidates", 150, *how) == 0
    by_body = read_grasp(out)
    assert 1.03 <= by_body.rho <= 26.2
    limits = shared("cases", "mug_by_handle", "only_handle.toml")
    assert run("grasp-plan", mug, "--limits", limits, "--fingers", 4, "--candidates", 600, *how) == 0
    assert read_grasp(out).rho == pytest.approx(26.1, rel=0.01)
    assert run("grasp-plan", bottle, "--body", "cap", "--candidates", 80, *how, "--lock-joints") == 0
    assert read_grasp(out).rho >= 1.37
    assert read_grasp(out).mass == pytest.approx(0.42)


def test_a_decomposed_object_keeps_its_body_its_joints_and_its_obstacles(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("planner.objects.mjcf.decompose._run_coacd", lambda vertices, _: [vertices, vertices])
    cup = mesh_cup(tmp_path).read_text()
    lid = '<body name="lid" pos="0 0 .06"><joint name="hinge"/><geom name="lid" type="box" size=".04 .04 .01"/></body>'
    path = written(tmp_path, cup.replace("</body>", f"{lid}</body>", 1))
    out = tmp_path / "cup.grasp.json"
    how = ("--body", "lid", "--lock-joints", "all", "--decompose", "--candidates", 40, "--fingers", 4)
    assert run("grasp-plan", path, *how, "--friction", 0.8, "--gap", 0.05, "--out", out) in (0, 3)
    grasp = read_grasp(out)
    assert grasp.file.name.endswith(".convex.xml")
    again = read_grasped_object(grasp)
    assert isinstance(again, RigidObject)
    assert [part.geom for part in again.parts if "/" not in part.geom] == ["lid"]
    assert [part.geom for part, free in zip(again.parts, again.touchable, strict=True) if free] == ["lid"]
    cut = [part for part in again.parts if "/" in part.geom]
    assert len(cut) == 2
    assert max(part.bounds()[1, 2] for part in cut) <= 0


def test_mass_loads_what_has_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    body = '<body name="part"><freejoint/><geom type="box" size=".025 .02 .03" mass="0"/></body>'
    path, out = written(tmp_path, world(body)), tmp_path / "p.grasp.json"
    assert run("grasp-inspect", path) == 1
    assert says(capsys.readouterr().err, "--mass")
    assert run("grasp-inspect", path, "--mass", 0.2, "--candidates", 20) == 0
    assert says(capsys.readouterr().out, r"mass +0.2 kg")
    assert run("grasp-plan", path, "--mass", 0.2, "--candidates", 40, *SEARCH, "--out", out) == 0
    assert run("grasp-validate", out, "--out", tmp_path / "v.json") == 0
    again = read_grasped_object(read_grasp(out))
    assert isinstance(again, RigidObject)
    assert again.mass == 0.2


@pytest.mark.parametrize(
    ("pose", "said"),
    [
        ('pos="0 0 1" euler="90 0 0"', r"at \(0, 0, 1000\) mm .* turned by 90° about \(1, 0, 0\)"),
        ('quat="-0.5 -0.5 -0.5 -0.5"', r".* turned by 120° about \(0.5774, 0.5774, 0.5774\)"),
        ('euler="0 0 -30"', r".* turned by 30° about \(0, 0, -1\)"),
        ('pos=".1 0 0"', r"at \(100, 0, 0\) mm .* not turned"),
        ("", r"at \(0, 0, 0\) mm .* not turned"),
    ],
)
def test_inspect_says_where_the_file_places_the_body(
    tmp_path: Path, pose: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, world(f'<body {pose}><freejoint/><geom size=".1"/></body>'))
    assert run("grasp-inspect", path, "--candidates", 10) == 0
    assert says(capsys.readouterr().out, f"pose +the body frame lies {said}")


def test_the_pose_is_that_of_the_named_body(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, world(MUG.replace('euler="20 30 40"', "")))
    assert run("grasp-inspect", path, "--body", "handle", "--candidates", 10) == 0
    assert says(capsys.readouterr().out, r"at \(1055, 2000, 3000\) mm .* turned by 90° about \(0, 0, 1\)")
