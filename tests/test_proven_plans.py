"""What `grasp-plan` calls proven is proven by the file that it writes, and what it did not check it does not claim."""

import json
from collections.abc import Callable
from itertools import count
from pathlib import Path

import pytest

from planner.grasps.grasp import Certificate
from planner.grasps.grasp_file import read_grasp
from planner.search.result import Status
from planner.verification.bound_check import BoundCheck, Claim, check_bound
from tests.tools.commands import ASSETS, run, says
from tests.tools.shared import shared

pytestmark = pytest.mark.slow

BOX = ASSETS / "box" / "box.xml"

STRENGTHS = "[[finger]]\n[[finger]]\nstrength = 0.7\n[[finger]]\nstrength = 1.3\n"


def test_a_search_whose_threshold_rose_while_rows_were_open_keeps_all_the_cuts_it_needs(tmp_path: Path) -> None:
    tin, out = shared("cases", "incomplete_proof", "tin.xml"), tmp_path / "tin.grasp.json"
    usual = ("--fingers", 3, "--task", "gravity", "--friction", 0.4, "--candidates", 300, "--seed", 0)
    assert run("grasp-plan", tin, *usual, "--out", out, "-q") == 0
    grasp = read_grasp(out)
    assert grasp.rho == pytest.approx(6.89912, rel=1e-4)
    assert grasp.proof_check is not None
    assert grasp.proof_check.share == 1
    assert run("grasp-verify", out) == 0


@pytest.mark.parametrize("seed", [0, 1])
def test_three_fingers_of_three_strengths_are_proven_to_a_millionth(seed: int, tmp_path: Path) -> None:
    hand, out = tmp_path / "hand.toml", tmp_path / "box.grasp.json"
    hand.write_text(STRENGTHS)
    usual = ("--limits", hand, "--candidates", 50, "--friction", 0.6, "--gap", 1e-6, "--seed", seed)
    assert run("grasp-plan", BOX, *usual, "--out", out, "-q") == 0
    grasp = read_grasp(out)
    assert grasp.gap <= 1e-6
    assert grasp.lower_bound <= grasp.rho
    assert grasp.proof_check is not None
    assert grasp.proof_check.share == 1
    assert run("grasp-verify", out) == 0


def test_how_much_was_checked_is_said_written_and_printed_for_scripts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "box.grasp.json"
    assert run("grasp-plan", BOX, "--candidates", 40, "--out", out, "--json") == 0
    printed = capsys.readouterr()
    assert says(printed.err, r"checked all subsets, by the code of grasp-verify, in \S+ s")
    assert json.loads(printed.out)["proof_check"] == json.loads(out.read_text())["proof_check"]
    assert json.loads(printed.out)["proof_check"]["share"] == 1


@pytest.mark.parametrize(
    ("asks", "words"),
    [
        (0, "checked nothing yet of this proof; grasp-verify checks it"),
        (40, r"checked \d\S* % of the subsets, .* in \S+ s; the rest is not checked yet, grasp-verify checks all"),
    ],
)
def test_a_check_that_is_cut_short_says_what_is_left(
    asks: int, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Stopped once it has asked so many times whether to go on."""

    def cut_short(certificate: Certificate, claim: Claim, stop: Callable[[], bool]) -> BoundCheck:
        times = count()
        return check_bound(certificate, claim, stop=lambda: stop() or next(times) >= asks)

    out = tmp_path / "box.grasp.json"
    monkeypatch.setattr("planner.verification.proof_check.check_bound", cut_short)
    monkeypatch.setattr("planner.verification.bound_check.BATCH", 64)
    assert run("grasp-plan", BOX, "--candidates", 40, "--out", out) == 0
    printed = capsys.readouterr().out
    assert "all subsets" not in printed
    assert says(printed, words)
    check = read_grasp(out).proof_check
    assert check is not None
    assert check.share < 1
    assert (check.share > 0) == (asks > 0)


def test_a_search_out_of_time_claims_neither_a_proof_nor_an_optimum(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "box.grasp.json"
    assert run("grasp-plan", BOX, "--fingers", 5, "--candidates", 300, "--time-limit", 1, "--out", out) == 4
    printed = capsys.readouterr().out
    assert read_grasp(out).status is Status.TIME_LIMIT
    for word in ("proven", "optimal", "all subsets"):
        assert word not in printed, word


def test_a_single_subset_is_not_called_subsets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = tmp_path / "points.csv"
    points.write_text("x,y,z\n0.03,0,0\n-0.03,0.005,0\n0,0.02,0\n")
    run("grasp-plan", BOX, "--friction", 0.9, "--candidates", points, "--out", tmp_path / "box.grasp.json")
    assert "(1 subset) need" in capsys.readouterr().out
