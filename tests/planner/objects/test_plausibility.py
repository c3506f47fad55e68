"""What is almost always a mistake is said with its value and its likely cause, and nothing else is."""

import logging
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.objects.given_mass import GivenMass
from planner.objects.mass_doubts import height_outside, mass_doubts
from planner.objects.mjcf.reader import read_object
from planner.objects.planar.reader import read_planar
from planner.objects.plausibility import (
    candidate_doubts,
    friction_doubts,
    gravity_doubts,
    grid_doubts,
    size_doubts,
    torsion_doubts,
)
from planner.task import make_task
from tests.strategies.mjcf_files import world, written
from tests.strategies.parts import box, rigid_object
from tests.tools.commands import ASSETS, run
from tests.tools.lanes import first_fast

BOX = '<body name="brick"><freejoint/><geom name="side" type="box" size="{size}" mass="1" {more}/></body>'


def warned(caplog: pytest.LogCaptureFixture) -> list[str]:
    return [record.getMessage() for record in caplog.records if record.levelno >= logging.WARNING]


@pytest.mark.parametrize(
    ("length", "doubt"),
    [(0.0019, "1.9 mm long.*scale of 0.001"), (0.0021, None), (2.9, None), (3.1, "3100 mm long.*millimetres")],
)
def test_sizes_of_another_unit_are_doubted(length: float, doubt: str | None) -> None:
    doubts = size_doubts(rigid_object(box((length / 2, length / 4, length / 4))))
    assert len(doubts) == (doubt is not None)
    for said in doubts:
        assert doubt is not None
        assert re.search(doubt, said)


@pytest.mark.parametrize(
    ("torsion", "patch", "said"),
    [
        (0.0099, None, None),  # the rim of a disc of 19.8 mm radius: as wide as the object is in two directions
        (
            0.0101,
            None,
            "torsional friction of 10.1 mm takes a patch of 20.2 mm radius or more at friction 0.5, and the",
        ),
        (3.5, None, "of 3500 mm takes .* the object is 60 x 40 x 30 mm; .* lengths in metres: were millimetres given"),
        (None, 0.004, None),
        (None, 0.031, "patch of 20.7 mm radius or more at friction 0.5"),
        (None, 4.0, "were millimetres given"),
        (0.0, None, None),
    ],
)
def test_torsional_friction_for_which_the_object_has_no_room_is_doubted(
    torsion: float | None, patch: float | None, said: str | None
) -> None:
    brick = rigid_object(box((0.03, 0.02, 0.015)))
    doubts = torsion_doubts(brick, make_candidates(brick, "20", 0.5).twisting(torsion, patch).contacts)
    assert len(doubts) == (said is not None)
    assert not doubts or re.search(said or "", doubts[0])


def test_the_command_doubts_the_pads_of_limits_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    jaw = tmp_path / "jaw.toml"
    jaw.write_text("[[finger]]\npatch = 6\n[[finger]]\ntorsion = 0")
    given = ["--fingers", 2, "--candidates", 30, "--out", tmp_path / "box.grasp.json"]
    assert run("grasp-plan", ASSETS / "box" / "box.xml", *given, "--limits", jaw) == 0
    assert "were millimetres given" in capsys.readouterr().err
    assert run("grasp-plan", ASSETS / "box" / "box.xml", *given, "--patch", 0.006) == 0
    assert "millimetres" not in capsys.readouterr().err


def test_a_planar_outline_in_millimetres_is_doubted(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    text = (ASSETS / "planar" / "convex.toml").read_text()
    path = tmp_path / "plate.toml"
    path.write_text(text)
    read_planar(path)
    assert not warned(caplog)
    corners = "outline = [[0, 0], [80, 0], [0, 60]]"
    path.write_text(f'format = "rhograsp.planar"\nname = "plate"\nmass = 1\nfriction = 0.3\n{corners}')
    read_planar(path)
    assert "80000 mm long" in warned(caplog)[0]


@pytest.mark.parametrize(
    ("center", "outside"),
    [((0, 0, 0), 0.0), ((0.9, 0, 0), 0.0), ((0, 0, 0.99), 0.0), ((1.5, 0, 0), 0.0), ((0, 0, 1.2), 0.2), ((3, 0, 0), 1)],
)
def test_height_outside_is_over_the_hull_of_all_parts(center: tuple[float, float, float], outside: float) -> None:
    """Two cubes with a gap between: a centre of mass in the gap is none to doubt."""
    pair = rigid_object(box((1, 1, 1), (-1, 0, 0)), box((0.5, 1, 1), (1.5, 0, 0)))
    assert height_outside(pair, np.array(center, dtype=float)) == pytest.approx(outside, abs=1e-9)


def test_a_centre_of_mass_outside_the_hull_is_doubted_with_the_place_and_the_distance() -> None:
    cube = rigid_object(box((0.05, 0.05, 0.05)))
    good = replace(cube, inertia=1e-4 * np.eye(3))
    assert mass_doubts(good) == []
    given = good.weighing(GivenMass(center_of_mass=np.array([0, 0, 0.06])))
    (doubt,) = mass_doubts(given)
    assert "(0, 0, 60) mm, is 10 mm outside the convex hull" in doubt
    assert mass_doubts(good.weighing(GivenMass(center_of_mass=np.array([0.04, 0.04, 0.04])))) == []


@pytest.mark.parametrize("gravity", ["1.62", "0", "20"])
@pytest.mark.parametrize("task", ["gravity", "paper", "set = {kind = 'gravity', radius = 0.01}"])
def test_another_gravity_than_the_presets_take_is_said_once(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, gravity: str, task: str
) -> None:
    text = world(BOX.format(size=".05 .05 .05", more=""))
    thing = read_object(written(tmp_path, text.replace("<mujoco>", f'<mujoco><option gravity="0 0 -{gravity}"/>')))
    if "=" in task:
        task = str(written(tmp_path, task, "task.toml"))
    make_task(task, thing)
    (said,) = warned(caplog)
    assert f"gravity {gravity} m/s2, but this task takes the weight at 9.81" in said


def test_gravity_is_not_doubted_where_it_does_not_matter(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    text = world(BOX.format(size=".05 .05 .05", more="")).replace("<mujoco>", '<mujoco><option gravity="0 1.62 0"/>')
    thing = read_object(written(tmp_path, text))
    make_task("axes6", thing)
    make_task(str(written(tmp_path, "set = {kind = 'single', wrench = [0, 0, -1, 0, 0, 0]}", "t.toml")), thing)
    assert not warned(caplog)
    for stated in (9.8, 9.81, 9.80665, 9.78, None):
        assert gravity_doubts(stated, 9.81) == []


def test_a_grid_wider_than_a_part_is_doubted(caplog: pytest.LogCaptureFixture) -> None:
    pair = rigid_object(box((0.1, 0.1, 0.1)), box((0.01, 0.01, 0.01), (0, 0, 0.11)))
    assert grid_doubts(pair, 0.019) == []
    assert "grid of 21 mm is wider than 'part'" in grid_doubts(pair, 0.021)[0]
    assert "'part' and 1 more" in grid_doubts(pair, 4.0)[0]
    make_candidates(pair, "grid:0.05", 0.5)
    assert "grid of 50 mm" in warned(caplog)[0]


@pytest.mark.parametrize(("friction", "doubted"), [(0.1, False), (2.0, False), (2.1, True), (30.0, True)])
def test_friction_of_no_material_is_doubted(friction: float, doubted: bool, caplog: pytest.LogCaptureFixture) -> None:
    make_candidates(rigid_object(box((0.1, 0.1, 0.1))), "30", friction)
    assert [f"coefficient of {friction:g} is more" in said for said in warned(caplog)] == ([True] if doubted else [])
    assert bool(friction_doubts(np.array([0.5, friction]))) == doubted


@pytest.mark.parametrize(("candidates", "doubted"), [(2, False), (3, False), (4, True), (29, True), (30, False)])
def test_few_candidates_are_doubted_unless_they_are_a_grasp(candidates: int, doubted: bool) -> None:
    assert bool(candidate_doubts(candidates, 3)) == doubted


def test_the_plan_says_that_candidates_are_few(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("grasp-plan", ASSETS / "box" / "box.xml", "--candidates", 29) == 0
    assert "WARNING: 29 candidates are few for 3 fingers" in capsys.readouterr().err
    assert run("grasp-plan", ASSETS / "box" / "box.xml", "--candidates", 30) == 0
    assert "WARNING" not in capsys.readouterr().err


@pytest.mark.parametrize("path", first_fast(sorted(ASSETS.glob("*/*.xml")), fast=2), ids=lambda path: path.stem)
def test_nothing_about_an_asset_is_doubted(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    thing = read_object(path)
    make_candidates(thing, "300")
    make_task("gravity", thing)
    assert not warned(caplog)
