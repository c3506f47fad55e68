"""A grasp keeps to the limits, and keeps the log of its search and how its candidates were chosen."""

from dataclasses import replace
from itertools import combinations, permutations
from math import dist

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.limits.limits import Finger, Limits, Zone
from planner.objects.rigid_object import RigidObject
from planner.planning import MOST_TRACE_LINES, plan, recorded
from planner.search.certified import CertifiedSearch
from planner.search.result import Progress
from planner.task import Task, make_task
from planner.verification.verify import verify


def line(seconds: float) -> Progress:
    return Progress(
        seconds=seconds,
        nodes=round(10 * seconds),
        open=1,
        lower_bound=0.5,
        incumbent=np.inf if seconds < 1 else 2.0,
        socp_solves=3,
        cuts=4,
    )


@pytest.mark.parametrize("lines", [1, 2, MOST_TRACE_LINES, MOST_TRACE_LINES + 1, 12_345])
def test_a_long_log_is_thinned_evenly_between_its_ends(lines: int) -> None:
    log = [line(float(k)) for k in range(lines)]
    seconds = np.array([kept.seconds for kept in recorded(log)])
    assert len(seconds) == min(lines, MOST_TRACE_LINES)
    assert (seconds[0], seconds[-1]) == (0, lines - 1)
    steps = np.diff(seconds)
    assert (steps > 0).all()
    assert np.ptp(steps) <= 1 if len(steps) else lines == 1


def test_the_kept_log_is_what_was_observed(prism: RigidObject) -> None:
    seen: list[Progress] = []
    candidates = make_candidates(prism, "60", None, seed=7, fingertip=0.001)
    grasp = plan(GraspProblem(prism, make_task("gravity", prism), candidates, 3), observe=seen.append)
    for kept, progress in zip(grasp.search.trace, seen, strict=True):
        for name in ("seconds", "nodes", "open", "lower_bound", "socp_solves", "cuts"):
            assert getattr(kept, name) == getattr(progress, name), name
        assert kept.incumbent == (progress.incumbent if np.isfinite(progress.incumbent) else None)
    choice = candidates.kept(np.arange(10)).choice  # what was asked for stays, whichever are left
    assert choice == grasp.candidate_choice
    assert choice is not None
    assert (choice.candidates, choice.friction, choice.fingertip, choice.seed) == ("60", None, 0.001, 7)


def test_fingers_keep_to_their_limits_and_no_choice_that_does_needs_less(prism: RigidObject) -> None:
    """Against all assignments of candidates to the three fingers in their order, by an independent solver."""
    candidates = make_candidates(prism, "14", 0.6, seed=1)
    points = candidates.contacts.points
    high = Zone(lower=(-1, -1, float(np.median(points[:, 2]))), upper=(1, 1, 1))
    tables = Finger(strength=0.4), Finger(within=high, strength=2.0), Finger(strength=0.4)
    limits = Limits(spacing=0.012, span=0.03, fingers=tables)
    task = Task(name="two", reference_point=np.zeros(3), wrenches=1.0 * np.eye(6)[[0, 2]])
    grasp = plan(GraspProblem(prism, task, candidates, 3, limits), CertifiedSearch(gap=1e-4))
    strength, solver = np.array([0.4, 2.0, 0.4]), ReferenceForces(3, 3)

    def rho(chosen: tuple[int, ...], least: float) -> float:
        contacts = replace(candidates.contacts.subset(np.array(chosen)), strength=strength)
        worst = 0.0
        for wrench in task.wrenches:
            if worst < least:
                problem = ForceProblem(contacts=contacts, reference_point=task.reference_point, wrench=wrench)
                worst = max(worst, solver.solve(problem).phi)
        return worst

    best, tried = np.inf, 0
    for chosen in permutations(range(len(points)), 3):
        lengths = [dist(points[i], points[j]) for i, j in combinations(chosen, 2)]
        kept = all(0.012 <= length <= 0.03 for length in lengths)
        if chosen[0] < chosen[2] and points[chosen[1], 2] >= high.lower[2] and kept:  # fingers 1 and 3 are alike
            best, tried = min(best, rho(chosen, best)), tried + 1
    assert tried > 100
    assert best * (1 - 1e-6) <= grasp.rho <= best * (1 + 2e-4)
    assert grasp.contacts.strengths.tolist() == strength.tolist()
    assert grasp.contacts.points[1, 2] >= high.lower[2]
    own = [int(np.flatnonzero((points == point).all(axis=1))[0]) for point in grasp.contacts.points]
    assert rho(tuple(own), np.inf) == pytest.approx(grasp.rho, rel=1e-6)
    assert not any(check.fails for check in verify(grasp))


def test_the_order_of_the_tables_is_that_of_the_contacts(prism: RigidObject, limited_grasp: Grasp) -> None:
    tables = Finger(strength=0.5), Finger(), Finger()
    limits = Limits(spacing=0.02, span=0.028, fingers=tables)
    candidates = make_candidates(prism, "case3", 0.3, seed=0)
    grasp = plan(GraspProblem(prism, make_task("paper", prism), candidates, 3, limits))
    assert grasp.contacts.strengths.tolist() == [0.5, 1.0, 1.0]
    assert grasp.rho == pytest.approx(limited_grasp.rho, rel=1e-3)
    assert max(grasp.lower_bound, limited_grasp.lower_bound) <= min(grasp.rho, limited_grasp.rho) * (1 + 1e-6)


def test_tables_that_say_nothing_change_nothing(prism: RigidObject) -> None:
    candidates = make_candidates(prism, "40", None, seed=3)
    task = make_task("gravity", prism)
    free = plan(GraspProblem(prism, task, candidates, 3))
    same = plan(GraspProblem(prism, task, candidates, 3, Limits(fingers=(Finger(),) * 3)))
    assert same.certificate.kinds == free.certificate.kinds == ()
    assert (same.rho, same.lower_bound, same.search.nodes) == (free.rho, free.lower_bound, free.search.nodes)
    np.testing.assert_array_equal(same.chosen, free.chosen)


def test_candidates_that_no_finger_may_use_are_left_out(prism: RigidObject) -> None:
    candidates = make_candidates(prism, "60", None, seed=3)
    limits = Limits(keep_out=(Zone(lower=(-1, -1, -1), upper=(1, 1, 0)),))
    grasp = plan(GraspProblem(prism, make_task("gravity", prism), candidates, 4, limits), CertifiedSearch(time_limit=1))
    assert (grasp.certificate.candidates.points[:, 2] > 0).all()


def test_before_the_first_grasp_the_log_says_none() -> None:
    assert [kept.incumbent for kept in recorded([line(0.0), line(2.0)])] == [None, 2.0]
