"""`grasp-inspect` and the options of `grasp-plan` for real objects, as users meet them."""

import json
from pathlib import Path

import pytest

from planner.grasps.grasp_file import read_grasp
from planner.grasps.grasped_object import read_grasped_object
from planner.objects.rigid_object import RigidObject
from tests.strategies.cups import box_cup, mesh_cup
from tests.tools.commands import ASSETS, PRISM, heavy_after_help, run, says

pytestmark = pytest.mark.slow


def test_inspect_shows_what_the_planner_sees(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    picture = tmp_path / "cup.png"
    assert run("grasp-inspect", box_cup(tmp_path), "--candidates", 50, "--out", picture) == 0
    out = capsys.readouterr().out
    for pattern in (
        r"body +cup: .* kg, 5 colliding geoms, no joints",
        r"size +80 x 80 x 80 mm",
        r"collides +geom0 +box of size 40 40 4 mm, friction 1",
        r"unreachable \d{4} of 20000",
        r"candidates +50, [\d.]+ mm apart",
        r"mujoco +confirms 50 of them",
        r"warning +none",
    ):
        assert says(out, pattern), pattern
    # outside of the cup 5 x 64 cm2, its rim 64 - 40.96, its inside 4 x 6.4 x 7.2 + 40.96
    measured = float(out.split("surface")[1].split()[0])
    assert measured == pytest.approx(320 + 23.04 + 184.32 + 40.96, rel=0.02)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_inspect_lists_the_bodies_even_when_none_can_be_chosen(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bodies = "".join(f'<body name="{name}"><geom size=".1"/></body>' for name in "ab")
    path = tmp_path / "two.xml"
    path.write_text(f"<mujoco><worldbody>{bodies}</worldbody></mujoco>")
    assert run("grasp-inspect", path) == 1
    seen = capsys.readouterr()
    assert says(seen.out, "body +a: .*body +b:")
    assert says(seen.err, "error: the file holds several objects.*--body")
    assert run("grasp-inspect", path, "--body", "b") == 0


def test_inspect_reports_warnings_once_and_knows_planar_objects(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("grasp-inspect", mesh_cup(tmp_path), "--candidates", 20) == 0
    seen = capsys.readouterr()
    assert seen.out.count("collides as its convex hull") == 1
    assert says(seen.out, "warning the visual mesh of body 'cup' is")
    assert seen.err == ""
    assert run("grasp-inspect", ASSETS / "planar" / "concave.toml", "--out", tmp_path / "p.png") == 0
    assert says(capsys.readouterr().out, "outline +12 corners")


def test_given_mass_and_centre_of_mass_are_planned_with_recorded_and_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "prism.grasp.json"
    given = ("--mass", 2, "--com", 0.001, 0.002, 0.003)
    assert run("grasp-plan", PRISM, "--candidates", 60, "--fingers", 4, *given, "--out", file) == 0
    assert says(capsys.readouterr().out, r"given +mass 2 kg, centre of mass \(1, 2, 3\) mm, in place of the file's")
    record = json.loads(file.read_text())["object"]
    assert (record["mass"], record["given_mass"]) == (2, 2)
    assert record["given_center_of_mass"] == [0.001, 0.002, 0.003]
    grasp = read_grasp(file)
    assert grasp.task.reference_point.tolist() == [0.001, 0.002, 0.003]
    assert abs(grasp.task.wrenches[:, :3]).max() >= 2 * 9.8
    again = read_grasped_object(grasp)
    assert isinstance(again, RigidObject)
    assert (again.mass, again.center_of_mass.tolist()) == (2, [0.001, 0.002, 0.003])
    for bad, message in ((("--mass", 0), "mass is 0"), (("--com", 0, "nan", 0), "three finite numbers")):
        assert run("grasp-plan", PRISM, *bad, "--out", file) == 1
        assert says(capsys.readouterr().err, message)
    assert run("grasp-plan", ASSETS / "planar" / "convex.toml", "--mass", 1, "--out", file) == 1
    assert says(capsys.readouterr().err, "stands in its file")


def test_the_plan_says_whose_friction_it_took_and_what_it_dropped(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    points = tmp_path / "points.csv"
    points.write_text("0,0,-0.032\n0.03199,0,-0.032\n0.04,0,0\n-0.04,0.01,0\n0,0.04,0\n")
    run("grasp-plan", box_cup(tmp_path), "--candidates", points, "--out", tmp_path / "x.grasp.json")
    out = capsys.readouterr().out
    assert says(out, r"friction 1 \(the object's own\)")
    assert says(out, r"dropped +1 candidates .* 1 touching another part; 4 are left")


def test_the_script_is_the_command_and_its_help_loads_nothing_heavy() -> None:
    heavy, printed = heavy_after_help("inspect_object", "mujoco", "scipy", "trimesh", "matplotlib")
    assert not heavy
    assert says(printed, "What does the planner see")
