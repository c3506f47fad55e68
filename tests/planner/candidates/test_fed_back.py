"""Contacts that were printed or written by a plan are candidates again: the same places, facets and force."""

import re
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.candidates.even import even_candidates
from planner.candidates.listed import listed_candidates
from planner.errors import CandidateError
from planner.grasps.grasp_file import read_grasp
from planner.objects.object_file import read_object_file
from planner.objects.rigid_object import RigidObject
from tests.strategies.parts import box, rigid_object, tilted_parts
from tests.strategies.planar_objects import RECTANGLE, planar_object
from tests.tools.commands import ASSETS, run, says
from tests.tools.lanes import first_fast

OBJECTS = sorted(ASSETS.glob("*/*.xml"))
HALF_A_THOUSANDTH = 0.5e-6 * np.sqrt(3)
CUBE = rigid_object(box((0.05, 0.05, 0.05)))


@pytest.mark.parametrize("path", first_fast(OBJECTS, fast=2), ids=lambda path: path.stem)
def test_points_printed_to_a_thousandth_of_a_millimetre_are_accepted_on_every_asset(path: Path) -> None:
    thing = read_object_file(path)
    assert isinstance(thing, RigidObject)
    made = even_candidates(thing, 300, 0.5, seed=1)
    printed = np.round(made.contacts.points, 6)
    back = listed_candidates(thing, printed, 0.5, normals=made.contacts.normals)
    assert 0 <= back.moved <= HALF_A_THOUSANDTH
    assert np.abs(back.contacts.points - made.contacts.points).max() <= 2 * HALF_A_THOUSANDTH
    assert (back.contacts.normals * made.contacts.normals).sum(axis=1).min() > 0.9999


def test_no_more_is_allowed_than_rounding_needs() -> None:
    assert listed_candidates(CUBE, np.array([[0.05 + 0.99e-6, 0, 0]]), 0.5).moved == pytest.approx(0.99e-6, rel=1e-3)
    with pytest.raises(CandidateError, match=r"lies 1\.1e-06 m off the collision surface; at most 1e-06 m"):
        listed_candidates(CUBE, np.array([[0.05 + 1.1e-6, 0, 0]]), 0.5)


@pytest.mark.parametrize(
    ("asset", "task"), first_fast([("cylinder", "axes6"), ("bracket", "paper"), ("mug", "gravity")])
)
def test_a_grasp_that_was_printed_or_written_is_planned_again_with_the_same_rho(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], asset: str, task: str
) -> None:
    monkeypatch.chdir(tmp_path)
    given = ("grasp-plan", ASSETS / asset / f"{asset}.xml", "--task", task, "--friction", 0.6, "--candidates")
    assert run(*given, 60, "--out", "first.grasp.json") == 0
    lines = re.findall(r"^contact \d +(\S+) +(\S+) +(\S+) mm", capsys.readouterr().out, re.MULTILINE)
    Path("printed.csv").write_text("".join(",".join(f"{x}e-3" for x in line) + "\n" for line in lines))
    first = read_grasp("first.grasp.json")
    for candidates, accuracy in (("printed.csv", 1e-3), ("first.grasp.json", 1e-6)):
        assert run(*given, candidates, "--out", "again.grasp.json") == 0
        again = read_grasp("again.grasp.json")
        assert again.rho == pytest.approx(first.rho, rel=accuracy)
        moved = says(capsys.readouterr().out, r"moved onto the surface by at most 0\.000\d+ mm")
        assert moved == (candidates == "printed.csv" and asset != "bracket")  # its faces lie on whole millimetres


@pytest.mark.parametrize("normal", [(-1, 0, 0), (0, 0, -1), (-2, 0, -1), (-1e-3, 0, -2e-3)])
def test_the_stated_normal_decides_on_which_facet_of_an_edge_a_point_lies(normal: tuple[float, ...]) -> None:
    found = listed_candidates(CUBE, np.array([[0.05, 0.01, 0.05]]), 0.5, normals=np.array([normal], dtype=float))
    expected = np.zeros(3)
    expected[np.abs(normal).argmax()] = -1
    np.testing.assert_allclose(found.contacts.normals, [expected], atol=1e-12)


def test_every_edge_and_corner_of_every_part_keeps_the_facet_that_is_stated() -> None:
    for part in tilted_parts().values():
        thing = rigid_object(part)
        triangles, facets = part.triangles()
        points, normals = part.project(triangles.reshape(-1, 3), np.repeat(facets, 3))
        found = listed_candidates(thing, points, 0.5, normals=normals)
        assert (found.contacts.normals * normals).sum(axis=1).min() > 1 - 1e-9


def test_a_corner_in_the_plane_lies_on_the_edge_whose_normal_is_stated() -> None:
    plate = planar_object(RECTANGLE)
    outline = plate.outline
    for edge, normal in enumerate(outline.normals):
        for corner in (outline.corners[edge], outline.corners[(edge + 1) % len(outline.corners)]):
            found = listed_candidates(plate, corner[None], 0.5, normals=normal[None])
            np.testing.assert_allclose(found.contacts.normals, normal[None], atol=1e-12)


def test_normals_are_read_behind_the_points(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("x,y,z,nx,ny,nz\n0.05,0.01,0.05,0,0,-1\n0.05,0,0.05,-1,0,0\n")
    found = make_candidates(CUBE, str(path), 0.5)
    np.testing.assert_allclose(found.contacts.normals, [[0, 0, -1], [-1, 0, 0]], atol=1e-12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.05,0,0,1,0,0", r"the normal \(1, 0, 0\) of point 1 of 1 does not point into the object, .* \(-1, 0, 0\)"),
        ("0.05,0,0,0,0,0", "a normal in .* is zero"),
        ("0.05,0,0,-1,0,0\n0.05,0,0", "line 2 .* expected finite numbers x,y,z,nx,ny,nz"),
        ("0.05,0,0\n0.05,0,0,-1,0,0", "line 2 .* expected finite numbers x,y,z$"),
        ("0.05,0,0,-1", "line 1 .* expected finite numbers x,y,z or x,y,z,nx,ny,nz"),
        ("0.05,0,0,-1,0,nan", "line 1"),
    ],
)
def test_normals_that_are_none_are_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "points.csv"
    path.write_text(text)
    with pytest.raises(CandidateError, match=message):
        make_candidates(CUBE, str(path), 0.5)


def test_grasp_files_without_contacts_or_of_another_dimension_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    box_file, plate = ASSETS / "box" / "box.xml", ASSETS / "planar" / "convex.toml"
    assert run("grasp-plan", box_file, "--fingers", 2, "--candidates", 30, "--out", "none.grasp.json") == 3
    assert run("grasp-plan", plate, "--friction", 0.5, "--candidates", 30, "--out", "plate.grasp.json") == 0
    capsys.readouterr()
    for file, message in (("none", "holds no contacts"), ("plate", "holds contacts in 2 dimensions; expected .* in 3")):
        assert run("grasp-plan", box_file, "--candidates", f"{file}.grasp.json") == 1
        assert says(capsys.readouterr().err, f"error: .*{message}")
    Path("broken.json").write_text("{}")
    assert run("grasp-plan", box_file, "--candidates", "broken.json") == 1
    assert says(capsys.readouterr().err, "error: broken.json")


def test_the_contacts_of_a_soft_grasp_are_places_and_how_they_twisted_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As friction, torsional friction is the fingers' and said with them; whoever forgets it is told the option."""
    soft, again = tmp_path / "soft.grasp.json", tmp_path / "again.grasp.json"
    given = ["grasp-plan", ASSETS / "box" / "box.xml", "--fingers", 2]
    assert run(*map(str, given), "--candidates", 80, "--patch", 0.004, "--out", soft) == 0
    assert "only their places" not in capsys.readouterr().err
    assert run(*map(str, given), "--candidates", soft, "--out", again) == 3
    said = " ".join(capsys.readouterr().err.split())
    (option,) = re.findall(r"with a torsional friction of 1\.33 mm; only their places .*--torsion ([\d.]+) plans", said)
    assert run(*map(str, given), "--candidates", soft, "--torsion", option, "--out", again) == 0
    assert "only their places" not in capsys.readouterr().err
    assert read_grasp(again).rho == pytest.approx(read_grasp(soft).rho, rel=1e-5)
    assert run("grasp-verify", again) == 0
