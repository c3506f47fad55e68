"""A proof is called one once the independent code has checked it; a search that is wrong on purpose is noticed."""

import logging
from collections.abc import Callable
from dataclasses import replace
from itertools import chain, repeat
from pathlib import Path

import pytest

import planner.verification.bound_check
import planner.verification.proof_check
from planner.grasps.grasp_file import read_grasp
from planner.search.branch_and_bound import BranchAndBound
from planner.search.certified import CertifiedSearch
from planner.search.minimal_cuts import minimal_cuts
from planner.search.regions.rows import BoundedRows
from planner.search.result import SearchResult, Status
from planner.verification.bound_check import Claim, check_bound
from planner.verification.proof_check import certificate_of, with_checked_proof
from planner.verification.verify import verify
from tests.strategies.small_objects import small_problem
from tests.tools.commands import ASSETS, run
from tests.tools.lanes import first_fast

SEED = 9
"""A small problem with a grasp and hundreds of cuts."""

BOX = ("grasp-plan", ASSETS / "box" / "box.xml", "--candidates", 60, "--task", "gravity")


@pytest.fixture(scope="module")
def true_result() -> SearchResult:
    result = CertifiedSearch(gap=0.0).run(small_problem(SEED))
    assert result.status in (Status.OPTIMAL, Status.UNRESOLVED)
    return replace(result, status=Status.OPTIMAL)


def never() -> bool:
    return False


def proves(result: SearchResult) -> bool:
    """Whether all subsets are covered."""
    problem = result.problem
    certificate = certificate_of(result)
    return check_bound(
        certificate, Claim(problem.fingers, problem.reference_point, problem.wrenches, result.lower_bound)
    ).proven


def without_a_needed_cut(result: SearchResult) -> SearchResult:
    """The cuts of a proof, of which the first ones are taken away until it is none."""
    few = minimal_cuts(result)
    shorter = (replace(result, cuts=few[cut:]) for cut in range(1, len(few)))
    return next(each for each in shorter if not proves(each))


def claims_a_millionth_more(result: SearchResult) -> SearchResult:
    """A bound that is higher than what the cuts prove by a millionth of it."""
    return replace(result, lower_bound=result.lower_bound * (1 + 1e-6))


def test_a_true_proof_is_handed_on_as_it_is(true_result: SearchResult, caplog: pytest.LogCaptureFixture) -> None:
    checked, check = with_checked_proof(true_result, never)
    assert check is not None
    assert check.share == 1
    assert (checked.status, checked.lower_bound) == (true_result.status, true_result.lower_bound)
    assert len(checked.cuts) <= len(true_result.cuts)
    assert not caplog.records


@pytest.mark.parametrize("faulty", [without_a_needed_cut, claims_a_millionth_more])
def test_a_faulty_search_is_noticed_and_its_bound_becomes_an_honest_one(
    true_result: SearchResult, faulty: Callable[[SearchResult], SearchResult], caplog: pytest.LogCaptureFixture
) -> None:
    false = faulty(true_result)
    with caplog.at_level(logging.WARNING):
        checked, check = with_checked_proof(false, never)
    assert checked.status is Status.UNRESOLVED
    assert 0 < checked.lower_bound < false.lower_bound
    assert check is not None
    assert check.share == 1
    assert proves(checked)
    assert "the search's proof does not check" in caplog.text


def test_wherever_the_check_is_stopped_no_lowered_bound_is_handed_on_that_is_not_proven(
    true_result: SearchResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A third of the cuts leaves several counterexamples, one below the other."""
    monkeypatch.setattr(planner.verification.bound_check, "BATCH", 4)
    false = replace(true_result, cuts=minimal_cuts(true_result)[::3])
    given_up, lowered = 0, 0
    for patience in range(40, 170, 6):
        answers = chain(repeat(False, patience), repeat(True))
        checked, check = with_checked_proof(false, answers.__next__)
        if checked.lower_bound == 0:
            assert check is None
            given_up += 1
        elif checked.lower_bound < false.lower_bound:
            assert proves(checked), patience
            lowered += 1
    assert given_up and lowered


def test_a_faulty_choice_of_few_cuts_is_mended_by_all_of_them(
    true_result: SearchResult, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    few = without_a_needed_cut(true_result).cuts
    monkeypatch.setattr(planner.verification.proof_check, "minimal_cuts", lambda *_: few)
    checked, check = with_checked_proof(true_result, never)
    assert check is not None
    assert check.share == 1
    assert checked.cuts is true_result.cuts
    assert checked.status is true_result.status
    assert not caplog.records


def test_a_check_that_is_stopped_claims_no_share_it_has_not_reached(true_result: SearchResult) -> None:
    _, check = with_checked_proof(true_result, lambda: True)
    assert check is not None
    assert check.share == 0


def forgets_cuts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows are pruned, and the cuts that pruned them do not become part of the proof."""

    def unpruned(self: BranchAndBound, rows: BoundedRows) -> BoundedRows:
        open_ = rows.bounds > self.threshold
        self.remember(rows.bounds[~open_])
        return rows[open_]

    monkeypatch.setattr(BranchAndBound, "unpruned", unpruned)


def claims_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bound is that of the best grasp: what a search would say that takes it for the best without looking."""
    monkeypatch.setattr(BranchAndBound, "lower_bound", lambda self: self.incumbents.rho)


@pytest.mark.parametrize("fault", first_fast([forgets_cuts, claims_too_much]))
def test_planning_with_a_faulty_search_never_says_optimal(
    fault: Callable[[pytest.MonkeyPatch], None],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = tmp_path / "box.grasp.json"
    fault(monkeypatch)
    assert run(*BOX, "--gap", 1e-2, "--out", out) == 4
    printed = capsys.readouterr()
    assert "optimal" not in printed.out
    assert "proven" not in printed.out
    assert "the search's proof does not check" in printed.err
    grasp = read_grasp(out)
    assert grasp.status is Status.UNRESOLVED
    assert grasp.lower_bound < grasp.rho
    assert all(check.holds for check in verify(grasp))
