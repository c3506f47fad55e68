"""Planar objects are first-class input of the same commands."""

import json
from pathlib import Path

import pytest

from tests.tools.commands import ASSETS, run, says

pytestmark = pytest.mark.slow

PLATE = ASSETS / "planar" / "convex.toml"


def plan_plate(out: Path, *arguments: object) -> int:
    return run("grasp-plan", PLATE, "--friction", 0.3, "--task", "paper", "--candidates", 56, "--out", out, *arguments)


@pytest.mark.parametrize("fingers", [2, 3])
def test_a_planar_grasp_is_planned_verified_validated_and_shown(
    fingers: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    grasp, validation = tmp_path / "plate.grasp.json", tmp_path / "plate.validation.json"
    assert plan_plate(grasp, "--fingers", fingers) == 0
    assert says(capsys.readouterr().out, r"80 x 70 mm.*paper: 16 wrenches.*rho +(1\.74741|0\.97813\d) N.* mm on plate")
    assert len(json.loads(grasp.read_text())["contacts"][0]["position"]) == 2
    assert run("grasp-verify", grasp) == 0
    assert "FAIL" not in capsys.readouterr().out
    assert run("grasp-validate", grasp, "--out", validation) == 0
    assert says(capsys.readouterr().out, "16 of 16 wrenches held.* verdict +PASS")
    assert run("grasp-convert", grasp, "--out", tmp_path / "plate.glb") == 0
    assert (tmp_path / "plate.glb").read_bytes()[:4] == b"glTF"


def test_a_changed_outline_is_noticed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    copy, grasp = tmp_path / PLATE.name, tmp_path / "plate.grasp.json"
    copy.write_text(PLATE.read_text())
    assert run("grasp-plan", copy, "--candidates", 20, "--fingers", 2, "--out", grasp, "-q") == 0
    copy.write_text(PLATE.read_text().replace("0.3", "0.31", 1))
    assert run("grasp-validate", grasp, "--out", tmp_path / "v.json") == 1
    assert says(capsys.readouterr().err, "has changed since the grasp was planned")
    assert run("grasp-validate", grasp, "--object", PLATE, "--out", tmp_path / "v.json", "-q") == 0


def test_bad_planar_input_is_refused_with_a_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bow_tie = tmp_path / "bow_tie.toml"
    bow_tie.write_text(
        'format = "rhograsp.planar"\nname = "bow"\nmass = 1\nfriction = 1\noutline = [[0, 0], [2, 2], [2, 0], [0, 3]]'
    )
    for arguments, message in (
        ((bow_tie,), "edges 0 and 2 of 'bow' meet"),
        ((tmp_path / "nowhere.toml",), "nowhere.toml"),
        ((PLATE, "--body", "lid"), "no body 'lid'"),
        ((PLATE, "--candidates", "case3"), "case3 lists points in space"),
        ((PLATE, "--task", ASSETS / "tasks" / "pour.toml"), "expected .1 or more, 3."),
        ((PLATE, "--friction", 0), "friction.*0"),
    ):
        assert run("grasp-plan", *arguments, "--out", tmp_path / "x.grasp.json") == 1, arguments
        assert says(capsys.readouterr().err, f"^error: .*{message}"), arguments
    assert not (tmp_path / "x.grasp.json").exists()


def test_one_finger_is_proven_not_to_hold_a_plate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    grasp = tmp_path / "one.grasp.json"
    assert plan_plate(grasp, "--fingers", 1) == 3
    assert says(capsys.readouterr().out, "infeasible +proven")
    assert run("grasp-verify", grasp) == 0
