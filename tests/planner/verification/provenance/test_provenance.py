"""What the user's files say now against what a grasp says they said; and what cannot be checked is said."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.candidates.confirmed import confirmed_candidates
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import read_grasp, write_grasp
from planner.limits.limits import Finger, Limits, Zone
from planner.objects.mjcf.reader import read_object
from planner.objects.object_file import read_object_file
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.task import Task, make_task
from planner.verification.check import Result
from planner.verification.provenance.provenance import check_provenance
from tests.strategies.filed_plans import LIMITS, POINTS, TASK, document_of, filed_plan
from tests.tools.commands import ASSETS, ROOT, run, says
from tests.tools.lanes import first_fast
from tests.tools.shared import shared

QUICK = CertifiedSearch(time_limit=0.05)


@pytest.fixture
def filed(tmp_path: Path) -> Path:
    return filed_plan(tmp_path)


def results(grasp: Grasp) -> dict[str, tuple[Result, str]]:
    """Result and detail of every claim about the object that does not simply hold."""
    checks = check_provenance(grasp)
    return {check.claim: (check.result, check.detail) for check in checks if not check.holds}


def only(file: Path) -> tuple[str, Result, str]:
    """The one claim of a file that does not hold, how it came out, and why."""
    ((claim, (result, detail)),) = results(read_grasp(file)).items()
    return claim, result, detail


def edited(file: Path, key: str, value: Any) -> Path:
    """A file with another value at `a/b`."""
    document = document_of(file)
    *folders, last = key.split("/")
    at = document
    for folder in folders:
        at = at[folder]
    at[last] = value
    file.write_text(json.dumps(document))
    return file


def test_a_plan_of_files_is_true_wherever_it_is_read_from(
    filed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert results(read_grasp(filed)) == {}
    monkeypatch.chdir(tmp_path)
    assert results(read_grasp(filed.name)) == {}
    assert document_of(filed)["task"]["file"]["path"] == "knock.toml"


@pytest.mark.parametrize(
    ("name", "content", "claim", "why"),
    [
        ("knock.toml", TASK.replace("20", "10"), "the task 'knock' is that of", "has changed since; its forces differ"),
        ("knock.toml", "set = 3", "the task 'knock' is that of", "has changed since; .*Expected `object`"),
        ("knock.toml", TASK.replace("knock", "bump"), "the task 'knock' is that of", "it should be 'bump'"),
        (
            "points.csv",
            POINTS.replace("0.02,0.012", "0.01,0.012"),
            "those of the file",
            "24 candidates, 2 not of this choice",
        ),
        (
            "points.csv",
            POINTS + "0.015,0.012,0.072",
            "those of the file",
            "it gives 26, 2 of them missing",
        ),
        (
            "limits.toml",
            LIMITS.replace("0.004", "0.003"),
            "those of the file",
            "spacing is 0.004 m, it should be",
        ),
        (
            "limits.toml",
            LIMITS.replace("0.8", "0.5"),
            "those of the file",
            "1 of strength 0.8; they should be",
        ),
        (
            "limits.toml",
            LIMITS.replace("-0.03", "-0.1"),
            "those of the file",
            "limits.toml has changed since; ",
        ),
        (
            "limits.toml",
            "spacing = -1",
            "those of the file",
            "has changed since; they cannot be chosen again",
        ),
    ],
)
def test_a_file_that_asks_for_something_else_now_is_noticed(
    filed: Path, name: str, content: str, claim: str, why: str
) -> None:
    (filed.parent / name).write_text(content.strip())
    failed, result, detail = only(filed)
    assert result is Result.FAILS and claim in failed
    assert says(detail, why)


@pytest.mark.parametrize(("name", "claim"), [("knock.toml", "the task 'knock'"), ("points.csv", "those of the file")])
def test_a_file_that_only_reads_otherwise_is_true_and_said_to_have_changed(filed: Path, name: str, claim: str) -> None:
    file = filed.parent / name
    file.write_text(file.read_text() + "\n# a comment\n")
    checks = check_provenance(read_grasp(filed))
    assert all(check.holds for check in checks)
    (changed,) = [check for check in checks if "has changed since" in check.detail]
    assert claim in changed.claim


@pytest.mark.parametrize("name", ["knock.toml", "points.csv", "limits.toml"])
def test_an_absent_file_is_said_and_refutes_nothing(filed: Path, name: str) -> None:
    (filed.parent / name).unlink()
    claim, result, detail = only(filed)
    assert result is Result.NOT_CHECKED
    assert name in claim and detail.endswith("is not there")


def test_an_absent_object_leaves_its_claims_open_line_by_line(
    filed: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    moved = (filed.parent / "hammer.xml").rename(tmp_path / "moved.xml")
    assert run("grasp-verify", filed) == 0
    printed = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in printed] == ["?"] * 4 + ["ok"] + ["?"] * 2 + ["ok"] * 7
    assert "hammer.xml is not there" in printed[0]
    assert run("grasp-verify", filed, "--json", "-q") == 0
    document = json.loads(capsys.readouterr().out)
    assert document["true"] is True and document["complete"] is False
    assert {check["result"] for check in document["checks"]} == {"holds", "not checked"}
    assert all(set(check) == {"claim", "result", "detail"} for check in document["checks"])
    assert run("grasp-verify", filed, "--object", moved, "--json", "-q") == 5  # another name: another digest
    assert "FAIL" not in capsys.readouterr().err


def test_another_object_at_the_same_place_is_noticed_and_nothing_else_is_judged(filed: Path) -> None:
    file = filed.parent / "hammer.xml"
    file.write_text(file.read_text().replace("0.06", "0.05"))
    first, *others = check_provenance(read_grasp(filed))
    assert first.fails and "has changed since the grasp was planned" in first.detail
    assert not any(check.fails for check in others)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("certificate/spacing", 0.001),
        ("certificate/span", 0.15),
        ("candidate_choice/friction", 0.8),
        ("candidate_choice/friction_error", 0.2),
    ],
)
def test_limits_and_friction_that_are_not_those_of_the_files_are_noticed(filed: Path, key: str, value: float) -> None:
    assert any(result is Result.FAILS for result, _ in results(read_grasp(edited(filed, key, value))).values())


def test_weakened_deleted_and_moved_candidates_of_a_listed_choice_are_noticed(filed: Path) -> None:
    grasp = read_grasp(filed)
    friction = grasp.certificate.candidates.friction
    assert friction == pytest.approx(0.81)
    document = document_of(filed)
    document["certificate"]["candidates"]["friction"][1] = 0.05
    filed.write_text(json.dumps(document))
    failed = results(read_grasp(filed))
    assert [result for result, _ in failed.values()] == [Result.FAILS] * 2
    assert any("friction" in claim for claim in failed)


def test_limits_made_in_python_leave_open_what_they_removed_but_admit_no_foreign_candidate(tmp_path: Path) -> None:
    box = read_object_file(ASSETS / "box" / "box.xml")
    candidates = make_candidates(box, "40", 0.5)
    limits = Limits(spacing=0.002, keep_out=(Zone(lower=(-1, -1, 0.005), upper=(1, 1, 1)),))
    grasp = plan(GraspProblem(box, make_task("axes6", box), candidates, 3, limits), QUICK)
    file = tmp_path / "box.grasp.json"
    write_grasp(file, grasp)
    claim, result, detail = only(file)
    assert result is Result.NOT_CHECKED and claim.endswith("within limits")
    assert "the caller's own" in detail
    document = document_of(file)
    document["certificate"]["candidates"]["positions"][0][0] += 1e-3
    file.write_text(json.dumps(document))
    assert any("1 of" in detail and "not of this choice" in detail for _, detail in results(read_grasp(file)).values())


def test_torsional_friction_of_limits_made_in_python_is_the_callers_own_and_that_of_a_file_is_checked(
    tmp_path: Path,
) -> None:
    box = read_object_file(ASSETS / "box" / "box.xml")
    limits = Limits(fingers=(Finger(patch=0.006), Finger(torsion=0)))
    grasp = plan(GraspProblem(box, make_task("gravity", box), make_candidates(box, "40", 0.5), 2, limits), QUICK)
    ((_, (result, detail)),) = results(grasp).items()
    assert result is Result.NOT_CHECKED
    assert says(detail, "removed 0 others, and given fingers their torsional friction, are the caller's own")
    jaw = tmp_path / "jaw.toml"
    jaw.write_text("[[finger]]\npatch = 0.006\n[[finger]]\ntorsion = 0")
    out = tmp_path / "box.grasp.json"
    given = ["--fingers", 2, "--candidates", 40, "--limits", jaw, "--out", out, "--quiet"]
    assert run("grasp-plan", box.file, *given) == 0
    assert results(read_grasp(out)) == {}
    jaw.write_text(jaw.read_text().replace("6", "5"))
    claim, result, detail = only(out)
    assert result is Result.FAILS and "those of the choice" in claim and "jaw.toml has changed since" in detail


def test_a_subset_made_in_python_is_no_lie_about_the_choice_it_is_of() -> None:
    box = read_object_file(ASSETS / "box" / "box.xml")
    candidates = make_candidates(box, "40", 0.5).subset(np.arange(30))
    grasp = plan(GraspProblem(box, make_task("axes6", box), candidates, 3), QUICK)
    ((_, (result, detail)),) = results(grasp).items()
    assert result is Result.NOT_CHECKED
    assert "removed 10 others" in detail


def test_a_task_made_in_python_is_said_to_be_the_callers_own() -> None:
    box = read_object_file(ASSETS / "box" / "box.xml")
    task = Task(name="lift", reference_point=box.center_of_mass, wrenches=np.array([[0, 0, -1.0, 0, 0, 0]]))
    grasp = plan(GraspProblem(box, task, make_candidates(box, "20", 0.5), 3), QUICK)
    ((claim, (result, detail)),) = results(grasp).items()
    assert "task 'lift'" in claim and result is Result.NOT_CHECKED and "caller's own" in detail


@pytest.mark.parametrize("name", first_fast(["bracket", "cylinder", "ellipsoid", "mug", "prism"], fast=2))
@pytest.mark.parametrize("confirmed", [True, False])
def test_honest_candidates_of_every_shape_are_true(name: str, confirmed: bool) -> None:
    file = ASSETS / name / f"{name}.xml"
    body = read_object(file)
    candidates = make_candidates(body, "50", None).least_friction(0.1)
    if confirmed:
        candidates = confirmed_candidates(body, candidates).candidates
    grasp = plan(GraspProblem(body, make_task("gravity", body), candidates, 3), QUICK)
    assert results(grasp) == {}


@pytest.mark.parametrize("name", ["bracket", "mug"])
def test_honest_pairs_are_true_and_those_of_another_seed_are_not(name: str) -> None:
    body = read_object(ASSETS / name / f"{name}.xml")
    pairs = make_candidates(body, "antipodal:50", None, seed=3).twisting(None, 0.004).least_friction(0.1)
    grasp = plan(GraspProblem(body, make_task("gravity", body), confirmed_candidates(body, pairs).candidates, 2), QUICK)
    assert results(grasp) == {}
    assert grasp.candidate_choice is not None
    forged = replace(grasp, candidate_choice=replace(grasp.candidate_choice, seed=4))
    assert [result for result, _ in results(forged).values()] == [Result.FAILS]


@pytest.mark.parametrize("choice", ["20", "grid:0.01"])
def test_honest_candidates_in_the_plane_are_true_and_moved_ones_are_not(choice: str) -> None:
    plate = read_object_file(ASSETS / "planar" / "concave.toml")
    grasp = plan(GraspProblem(plate, make_task("paper", plate), make_candidates(plate, choice, 0.5), 3), QUICK)
    assert results(grasp) == {}
    grasp.certificate.candidates.points[0] += 1e-3
    assert sum(result is Result.FAILS for result, _ in results(grasp).values()) == 2


def test_a_forged_task_of_an_older_file_is_refused_by_both(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = shared("faults", "forged_task_tenth")
    monkeypatch.chdir(ROOT)
    for side in folder.glob("f.grasp.*"):
        (tmp_path / side.name).write_bytes(side.read_bytes())
    moved = edited(tmp_path / "f.grasp.json", "object/mjcf", str(ASSETS / "box" / "box.xml"))
    assert run("grasp-verify", moved, "-q") == 5
    assert run("grasp-validate", moved, "-q") == 1
    assert says(capsys.readouterr().err, "it is false that the task is the preset 'axes6' of this object")


def test_given_torsional_friction_is_checked_where_the_points_are_gone(tmp_path: Path) -> None:
    (tmp_path / "jaws.csv").write_text("0.001,0.02,0\n0,-0.02,0.001\n0.03,0,0\n")
    out = tmp_path / "box.grasp.json"
    given = ["--fingers", 2, "--candidates", tmp_path / "jaws.csv", "--friction-error", 0.1, "--out", out, "--quiet"]
    for said in (("--patch", 0.004), ("--torsion", 0.002)):
        assert run("grasp-plan", ASSETS / "box" / "box.xml", *given, *said) == 0
        (tmp_path / "jaws.csv").rename(tmp_path / "gone.csv")
        assert [result for result, _ in results(read_grasp(out)).values()] == [Result.NOT_CHECKED]
        document = document_of(out)
        document["certificate"]["candidates"]["torsion"][2] *= 0.5
        out.write_text(json.dumps(document))
        wrong = {
            claim: detail for claim, (result, detail) in results(read_grasp(out)).items() if result is Result.FAILS
        }
        ((claim, detail),) = wrong.items()
        assert "torsional friction" in claim and claim.endswith("less 0.1 of it") and detail == "1 of 3 have another"
        (tmp_path / "gone.csv").rename(tmp_path / "jaws.csv")
