"""`grasp-plan --keep`: several files, each a grasp in its own right; and friction that is not known well."""

import json
from pathlib import Path

import pytest

from planner.grasps.grasp_file import numbered, read_grasp
from planner.search.result import Status
from planner.verification.verify import verify
from tests.tools.commands import run

PRISM = Path(__file__).resolve().parents[3] / "assets" / "prism" / "prism.xml"


def plan_prism(out: Path, *options: str) -> int:
    usual = ("--friction", 0.3, "--task", "paper", "--candidates", 60, "-q")
    return run("grasp-plan", PRISM, *usual, "--out", out, *options)


def test_each_file_holds_a_worse_grasp_that_verifies(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "prism.grasp.json"
    assert plan_prism(out, "--keep", "3", "--apart", "0.01", "--json") == 0
    grasps = [read_grasp(numbered(out, number)) for number in (1, 2, 3)]
    assert [grasp.status for grasp in grasps] == [Status.OPTIMAL, Status.ALTERNATIVE, Status.ALTERNATIVE]
    assert grasps[0].rho < grasps[1].rho <= grasps[2].rho
    assert len({grasp.lower_bound for grasp in grasps}) == 1
    assert all(check.holds for check in verify(grasps[1]))
    printed = json.loads(capsys.readouterr().out)
    written = json.loads(out.read_text())
    for key in ("status", "rho", "lower_bound", "gap", "proof_check", "critical_wrench", "contacts"):
        assert printed[key] == written[key], key
    assert [other["file"] for other in printed["others"]] == [str(numbered(out, 2)), str(numbered(out, 3))]


@pytest.mark.slow
def test_rho_with_a_friction_error_is_that_of_the_smallest_coefficient(tmp_path: Path) -> None:
    uncertain, least, most = (tmp_path / f"{name}.grasp.json" for name in ("uncertain", "least", "most"))
    assert plan_prism(uncertain, "--friction-error", "0.2") == 0
    assert plan_prism(least, "--friction", "0.24") == 0
    assert plan_prism(most, "--friction", "0.36") == 0
    rho = read_grasp(uncertain).rho
    assert rho == pytest.approx(read_grasp(least).rho, rel=2e-3)
    assert rho > 1.05 * read_grasp(most).rho
    choice = read_grasp(uncertain).candidate_choice
    assert choice is not None
    assert (choice.friction, choice.friction_error) == (0.3, 0.2)
    assert plan_prism(tmp_path / "x.grasp.json", "--friction-error", "1.0") == 1
