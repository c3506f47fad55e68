"""The benchmark of the search: its instances, its competitors, and a quick run of all of it."""

import os
import subprocess
import sys
import time
from dataclasses import replace
from itertools import combinations
from math import comb
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.errors import ObjectError, RhograspError, SettingError
from planner.objects.rigid_object import RigidObject
from planner.search.evaluation import Evaluator
from planner.search.exhaustive import exhaustive_search
from planner.search.problem import SearchProblem
from planner.search.result import Status
from planner.task import make_task
from scripts.benchmark_search import Options, benchmark
from scripts.search_benchmark.certified import Certified, CertifiedRun
from scripts.search_benchmark.competitors.annealing import anneal
from scripts.search_benchmark.competitors.early_exit import EarlyExit
from scripts.search_benchmark.competitors.enumeration import enumerate_subsets
from scripts.search_benchmark.competitors.mixed_integer import solve_with_cuts
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.competitors.paper import search_as_in_paper
from scripts.search_benchmark.competitors.restarts import restart
from scripts.search_benchmark.competitors.scattered import ScatteredSubsets
from scripts.search_benchmark.drill import SCAN, drill_problem
from scripts.search_benchmark.heuristics import Trials
from scripts.search_benchmark.instances import FULL, QUICK, TINY
from scripts.search_benchmark.isolated import run_isolated
from scripts.search_benchmark.measured import Measured
from scripts.search_benchmark.prism import prism_contacts, prism_problem
from tests.tools.commands import ROOT, says

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def tiny() -> SearchProblem:
    """Ten candidates, three fingers."""
    return TINY.problem()


@pytest.fixture(scope="module")
def optimum(tiny: SearchProblem) -> float:
    """rho* of the tiny problem, by the planner's own enumeration [N]."""
    best = exhaustive_search(tiny)
    assert best is not None
    return best.rho


def tables(text: str) -> dict[str, dict[str, dict[str, str]]]:
    """Cells of a Markdown document: heading, then instance, then column."""
    found: dict[str, dict[str, dict[str, str]]] = {}
    for section in text.split("\n## ")[1:]:
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in section.splitlines() if line[:1] == "|"]
        found[section.partition("\n")[0]] = {row[0]: dict(zip(rows[0], row, strict=True)) for row in rows[2:]}
    return found


def test_a_quick_run_makes_tables_whose_answers_agree_and_a_figure(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "scripts" / "benchmark_search.py"), "--quick", "--out", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "search.md").read_text() == done.stdout.removesuffix("\n")
    assert (tmp_path / "search.png").read_bytes()[:4] == b"\x89PNG"
    proofs, times, answers, heuristics = tables(done.stdout).values()
    assert list(proofs) == list(times) == list(answers) == [each.name for each in QUICK.instances]
    for name, row in answers.items():
        rho = float(proofs[name]["rho [N]"])
        finished = [column for column in row if column != "instance" and not times[name][column].startswith(">")]
        assert {"certified", "enumeration"} <= set(finished)
        assert [float(row[column].split()[0]) for column in finished] == pytest.approx([rho] * len(finished), 1.1e-3)
    (small,) = heuristics
    assert float(proofs[small]["verifier [s]"]) > 0
    assert proofs[small]["target [s]"] == "60: met"
    assert says(heuristics[small]["simulated annealing"], r"^\d of 3")


def test_a_name_that_no_instance_has_is_answered_by_their_names(tmp_path: Path) -> None:
    with pytest.raises(SettingError, match=r"called like duck; there are: Case III, m = 3; .*; drill scan, m = 3"):
        benchmark(Options(only=("duck",), out=tmp_path))


def test_the_undivided_prism_is_the_papers_case(prism: RigidObject) -> None:
    task, candidates = make_task("paper", prism), make_candidates(prism, "case3", 0.3, seed=0).contacts
    ours = prism_problem(prism_contacts(1), 3)
    expected = np.hstack([candidates.points, candidates.normals])
    found = np.hstack([ours.contacts.points, ours.contacts.normals])
    distance = np.abs(expected[:, None] - found).max(axis=2)
    assert distance.min(axis=1).max() < 1e-7  # the object's file stores its corners in single precision
    assert distance.min(axis=0).max() < 1e-7
    np.testing.assert_allclose(ours.wrenches, task.wrenches, rtol=1e-6)
    assert (ours.contacts.friction == candidates.friction).all()


@pytest.mark.parametrize(("division", "count"), [(2, 852), (3, 1905), (6, 7572)])
def test_divided_cells_stay_on_the_faces(division: int, count: int) -> None:
    contacts = prism_contacts(division)
    assert len(np.unique(contacts.points.round(9), axis=0)) == count
    reach = np.array([4 / 3, 4 / 3, 2 * np.sqrt(2) / 3, 1.0, 1.0]) / 100  # distances of the faces from the centroid
    faces = -np.array([[1, 0, 0], [0, 1, 0], [-(0.5**0.5), -(0.5**0.5), 0], [0, 0, 1], [0, 0, -1]])
    heights = contacts.points @ faces.T - reach
    assert np.abs(heights.max(axis=1)).max() < 1e-12
    np.testing.assert_allclose(-faces[heights.argmax(axis=1)], contacts.normals, atol=1e-12)


def test_the_drill_is_as_described_or_its_absence_is_said(tmp_path: Path) -> None:
    with pytest.raises(ObjectError, match=r"textured\.obj of the power drill is not beside the repository"):
        drill_problem(10, 3, tmp_path / "textured.obj")
    if not SCAN.is_file():
        pytest.skip("the shared objects are not here")
    problem = drill_problem(500, 3)
    arms = problem.contacts.points - problem.reference_point
    assert (arms * problem.contacts.normals).sum(axis=1).mean() < -0.25 * np.linalg.norm(arms, axis=1).mean()  # inward
    assert 0.1 < np.ptp(problem.contacts.points, axis=0).max() < 0.2
    nearest = np.linalg.norm(arms, axis=1).min()
    np.testing.assert_allclose(np.abs(problem.wrenches), [[1, 1, 1, *[0.8 * nearest] * 3]] * 64)


def test_the_scattered_order_holds_every_subset_once_and_evenly() -> None:
    for candidates, fingers in ((7, 3), (9, 1), (6, 6), (12, 5)):
        order = ScatteredSubsets(candidates, fingers)
        found = [tuple(order[number].tolist()) for number in range(len(order))]
        assert sorted(found) == list(combinations(range(candidates), fingers))
    order = ScatteredSubsets(100, 3)
    tenth = np.array([order[number] for number in range(len(order) // 10)])
    every = np.array(list(combinations(range(100), 3)))
    assert tenth.mean(axis=0) == pytest.approx(every.mean(axis=0), rel=0.01)


def test_all_competitors_find_the_optimum_of_a_tiny_problem(tiny: SearchProblem, optimum: float) -> None:
    for outcome in (enumerate_subsets(tiny, 60), search_as_in_paper(tiny, 1e-3, 60), solve_with_cuts(tiny, 1e-3, 60)):
        assert outcome.finished
        assert optimum * (1 - 1e-6) < outcome.rho <= optimum * (1 + 1e-3)
        assert outcome.lower_bound <= optimum * (1 + 1e-6)
    for heuristic in (anneal, restart):
        assert min(heuristic(tiny, 0.5, seed) for seed in range(4)) == pytest.approx(optimum)


def test_stopped_competitors_say_so_and_their_bounds_hold(optimum: float) -> None:
    problem = QUICK.tables[0].problem()  # the same optimum among more candidates
    enumeration = enumerate_subsets(problem, 0.02)
    assert not enumeration.finished
    assert enumeration.rho >= optimum * (1 - 1e-6)
    assert enumeration.seconds > 0.02
    assert says(enumeration.note, r"^extrapolated from [\d.]+ % done$")
    paper = search_as_in_paper(problem, 1e-3, 1e-6)
    assert not paper.finished
    assert paper.seconds > 1e-6
    cuts = solve_with_cuts(problem, 1e-3, 0.5)
    assert not cuts.finished
    assert 0 < cuts.lower_bound <= optimum * (1 + 1e-6) <= cuts.rho * (1 + 2e-6)


def test_cones_in_one_program_have_the_same_optimum(tiny: SearchProblem) -> None:
    pytest.importorskip("pyscipopt", reason="an optional competitor")
    from scripts.search_benchmark.competitors.mixed_integer_cone import solve_as_cone_program

    few = replace(tiny, wrenches=tiny.wrenches[:2])
    best = exhaustive_search(few)
    assert best is not None
    outcome = solve_as_cone_program(few, 1e-3, 60)
    assert outcome.finished
    assert outcome.rho == pytest.approx(best.rho, rel=1e-3)


def test_an_isolated_function_answers_is_stopped_or_is_mourned() -> None:
    answer = run_isolated(comb, 5, 2, limit=30)
    assert answer is not None
    assert answer.value == 10
    assert 1e6 < answer.peak_memory < 1e9
    began = time.perf_counter()
    assert run_isolated(time.sleep, 60, limit=0.1) is None
    assert time.perf_counter() - began < 30
    with pytest.raises(RhograspError, match="ended without an answer, exit code 7"):
        run_isolated(os._exit, 7, limit=30)


def test_answers_that_contradict_each_other_are_told(tiny: SearchProblem, optimum: float) -> None:
    run = CertifiedRun(
        seconds=1.0,
        processor_seconds=1.0,
        first_incumbent=1.0,
        nodes=1,
        socp_solves=1,
        status=Status.OPTIMAL,
        rho=optimum,
        lower_bound=optimum / 1.001,
        directions=np.empty((0, 6)),
    )
    agreeing = Measured(
        instance=TINY,
        candidates=len(tiny.contacts),
        fingers=tiny.fingers,
        subsets=tiny.subsets,
        certified=Certified(run=run, seconds=(1.0,), peak_memory=1, proven=True),
        outcomes={"enumeration": Outcome(seconds=1.0, finished=True, rho=optimum, lower_bound=optimum)},
        trials={"luck": Trials(seconds=1.0, rho=np.array([1.0, 1.0005, 1.3, np.inf, 1.1]) * optimum)},
    )
    assert list(agreeing.disagreements()) == []
    np.testing.assert_allclose(agreeing.trials["luck"].excess(optimum, 1e-3), [0.1, 0.3, np.inf])
    wrong = {
        "finds": replace(agreeing, outcomes={"enumeration": Outcome(seconds=1.0, finished=True, rho=1.1 * optimum)}),
        "below the proven": replace(agreeing, trials={"luck": Trials(seconds=1.0, rho=np.array([0.9 * optimum]))}),
        "bounds by": replace(
            agreeing, outcomes={"paper": Outcome(seconds=1.0, finished=False, lower_bound=1.1 * optimum)}
        ),
        "refutes": replace(agreeing, certified=replace(agreeing.certified, proven=False)),
        "ended as time_limit": replace(
            agreeing, certified=replace(agreeing.certified, run=replace(run, status=Status.TIME_LIMIT))
        ),
    }
    for words, measured in wrong.items():
        (sentence,) = measured.disagreements()
        assert words in sentence


def test_the_full_benchmark_measures_the_seven_instances_and_two_curves() -> None:
    assert len({each.name for each in FULL.tables}) == 7
    assert len(FULL.instances) == 14
    problems = [each.problem() for each in FULL.by_candidates]
    counts = [len(problem.contacts) for problem in problems]
    assert counts == sorted(counts)
    assert {problem.fingers for problem in problems} == {3}
    assert len({len(each.problem().contacts) for each in FULL.by_fingers}) == 1


def test_an_early_exit_changes_no_answer(tiny: SearchProblem) -> None:
    inner, outer = EarlyExit(tiny), Evaluator(tiny)
    for combination in list(combinations(range(len(tiny.contacts)), tiny.fingers))[::5]:
        rho = outer.evaluate(np.array(combination)).rho
        if np.isfinite(rho):
            assert inner.rho_below(np.array(combination), rho * 1.01) == pytest.approx(rho)
        assert inner.rho_below(np.array(combination), min(rho, tiny.force_ceiling)) == np.inf
