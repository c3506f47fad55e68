"""`grasp-plan --limits` as users meet it."""

import json
from itertools import combinations
from math import dist
from pathlib import Path

import pytest

from tests.tools.commands import ASSETS, run, says

MUG = ASSETS / "mug" / "mug.xml"
TABLE = "\n[table]\nnormal = [0, 0, 1]\nclearance = 0.02\n"


def plan_mug(folder: Path, limits: str, *arguments: object) -> int:
    path = folder / "hand.toml"
    path.write_text(limits)
    out = folder / "mug.grasp.json"
    return run("grasp-plan", MUG, "--candidates", 80, "--limits", path, "--out", out, *arguments)


def test_a_grasp_keeps_to_the_limits_and_says_what_they_cost(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert plan_mug(tmp_path, 'exclude_geoms = ["handle_*"]' + TABLE) == 0
    pattern = r"limits (\d+) candidates are not for fingers: \d+ by exclude_geoms, \d+ by table; (\d+) are left"
    assert says(capsys.readouterr().out, pattern)
    contacts = json.loads((tmp_path / "mug.grasp.json").read_text())["contacts"]
    assert all(contact["position"][2] >= 0.019 for contact in contacts)
    assert not any(contact["geom"].startswith("handle") for contact in contacts)
    assert run("grasp-verify", tmp_path / "mug.grasp.json") == 0


@pytest.mark.slow
def test_distances_and_the_fingers_own_limits_act(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    tables = '[[finger]]\ngeoms = ["wall*"]\n[[finger]]\nstrength = 0.5\ngeoms = ["handle*"]\n[[finger]]\n'
    assert plan_mug(tmp_path, "spacing = 0.03\nspan = 0.09\n" + tables) == 0
    out = capsys.readouterr().out
    assert says(out, r"fingers 1: strength 1, \d+ candidates 2: strength 0\.5, \d+ candidates 3: strength 1, 80 cand")
    assert says(out, r"rho .* N: every finger must be able to push its strength times this hard")
    assert says(out, r"contact 2 .* on handle\S+, strength 0\.5 contact 3")
    contacts = json.loads((tmp_path / "mug.grasp.json").read_text())["contacts"]
    assert contacts[0]["geom"].startswith("wall")
    assert contacts[1]["geom"].startswith("handle")
    assert [contact.get("strength") for contact in contacts] == [None, 0.5, None]
    for first, second in combinations(contacts, 2):
        assert 0.03 <= dist(first["position"], second["position"]) <= 0.09
    assert run("grasp-verify", tmp_path / "mug.grasp.json") == 0


def test_fingers_twist_as_their_limits_say_and_the_friction_error_counts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The shipped jaw: a pad against a hard edge."""
    out = tmp_path / "box.grasp.json"
    given = [ASSETS / "box" / "box.xml", "--fingers", 2, "--candidates", 80, "--out", out]
    given += ["--limits", ASSETS / "limits" / "box.toml", "--friction-error", 0.1]
    assert run("grasp-plan", *given) == 0
    said = capsys.readouterr().out
    assert says(said, r"torsion 0 to 1\.8 mm \(of the limits\)")
    assert says(said, r"fingers 1: strength 1, torsion 1\.8 mm, (\d+) candidates 2: strength 1, \1 candidates")
    assert says(said, r"contact 1 .*, torsion 1\.8 mm contact 2 .*, torsion 0 mm")
    contacts = json.loads(out.read_text())["contacts"]
    assert [contact.get("torsion") for contact in contacts] == [pytest.approx(2 / 3 * 0.45 * 0.006), None]
    assert run("grasp-verify", out) == 0


def test_limits_that_no_choice_keeps_are_proven_infeasible(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert plan_mug(tmp_path, "spacing = 0.12") == 3
    assert says(capsys.readouterr().out, "infeasible proven: no 3 of the 80 candidates resist the task")
    assert run("grasp-verify", tmp_path / "mug.grasp.json") == 0


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        ("span = -1", r"hand\.toml' is not a limits file: span is -1"),
        ('exclude_geoms = ["lid"]', "no geom 'lid'; it has wall0, .*handle_grip"),
        ('exclude_geoms = ["*"]', "exclude_geoms leaves none"),
        ("[[finger]]", r"1 tables \[\[finger\]\] for 3 fingers"),
        ("spacing = 1", "no two of the 80 candidates are more than"),
        ("span = 1e-4", "no two of the 80 candidates are less than"),
    ],
)
def test_limits_that_cannot_be_kept_are_refused(
    limits: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert plan_mug(tmp_path, limits) == 1
    assert says(capsys.readouterr().err, f"^error: .*{message}")
    assert not (tmp_path / "mug.grasp.json").exists()
