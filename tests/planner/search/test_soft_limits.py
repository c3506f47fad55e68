"""Soft fingers with all that the search can be asked for beside: strengths, the k best, distinct, position errors."""

from dataclasses import replace
from itertools import combinations, product

import numpy as np
import pytest

from planner.arrays import Floats, Indices
from planner.contacts import contact_frames
from planner.errors import CandidateError, ContactError
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.search.certified import CertifiedSearch
from planner.search.coarse_to_fine import CoarseToFine
from planner.search.evaluation import Evaluator
from planner.search.exhaustive import exhaustive_search
from planner.search.finger_kind import FingerKind
from planner.search.lower_bounds import Bound, LowerBounds
from planner.search.paper import PaperSearch
from planner.search.problem import SearchProblem
from planner.search.tie_break import tie_break
from scripts.search_benchmark.competitors.mixed_integer_cone import solve_as_cone_program
from tests.strategies.limited_problems import unlike_all
from tests.strategies.soft_problems import soft_problem

PAIRS = [seed for seed in range(120) if soft_problem(seed).fingers == 2]


def level(problem: SearchProblem, subset: tuple[int, ...], points: Floats | None = None) -> float:
    """rho of one subset, by the textbook model, of contacts that may have been missed [N]."""
    contacts = problem.fingertips.subset(np.array(subset))
    if points is not None:
        contacts = replace(contacts, points=points)
    solver = ReferenceForces(len(subset), 3, twisting=True)
    return max(
        solver.solve(ForceProblem(contacts=contacts, reference_point=problem.reference_point, wrench=wrench)).phi
        for wrench in problem.wrenches
    )


def every_rho(problem: SearchProblem) -> dict[tuple[int, ...], float]:
    """rho of all subsets that resist the task, each alone [N]."""
    evaluator, subsets = Evaluator(problem), combinations(range(len(problem.contacts)), problem.fingers)
    rho = {each: evaluator.evaluate(np.array(each)).rho for each in subsets if problem.admits(np.array(each))}
    return {subset: value for subset, value in rho.items() if value < problem.force_ceiling}


def test_a_finger_that_is_twice_as_strong_twists_twice_as_hard() -> None:
    """All strengths doubled halve rho; one of them doubled lowers it or leaves it, and enumeration agrees."""
    lower = 0
    for seed in PAIRS[:24]:
        problem = replace(soft_problem(seed), kinds=())
        count, best = len(problem.contacts), CertifiedSearch(gap=1e-6).run(problem)
        both = replace(problem, kinds=(FingerKind(fingers=2, candidates=count, strength=2.0),))
        assert CertifiedSearch(gap=1e-6).run(both).rho == pytest.approx(best.rho / 2, rel=1e-5)
        half = count // 2
        split = FingerKind(fingers=1, candidates=half), FingerKind(fingers=1, candidates=count - half)
        alike = CertifiedSearch(gap=1e-6).run(replace(problem, kinds=split))
        uneven = replace(problem, kinds=(replace(split[0], strength=2.0), split[1]))
        found, enumerated = CertifiedSearch(gap=1e-6).run(uneven), exhaustive_search(uneven)
        assert found.rho == pytest.approx(np.inf if enumerated is None else enumerated.rho, rel=1e-5)
        assert found.rho <= alike.rho * (1 + 1e-5)
        lower += found.rho < 0.99 * alike.rho
        if found.incumbent is not None:
            assert found.rho == pytest.approx(level(uneven, tuple(found.incumbent.subset.tolist())), rel=1e-5)
    assert lower >= 3


def test_the_k_best_of_soft_fingers_are_the_k_best() -> None:
    several = 0
    for seed in PAIRS[:24]:
        problem = soft_problem(seed)
        rho = sorted(every_rho(problem).values())
        found = CertifiedSearch(keep=4, gap=0.0).run(problem)
        np.testing.assert_allclose([grasp.rho for grasp in found.grasps], rho[:4], rtol=1e-5)
        several += len(found.grasps) == 4
    assert several >= 5


def test_soft_grasps_apart_are_each_the_best_unlike_those_before() -> None:
    several = 0
    for seed in PAIRS[:20]:
        problem = soft_problem(seed)
        apart, points, values = 0.6 * problem.length, problem.contacts.points, every_rho(problem)
        earlier: list[Indices] = []
        for grasp in CertifiedSearch(gap=0.0, keep=3, apart=apart).run(problem).grasps:
            unlike = [
                rho
                for subset, rho in values.items()
                if unlike_all(points[list(subset)], [points[each] for each in earlier], apart)
            ]
            assert grasp.rho == pytest.approx(min(unlike), rel=1e-5)
            earlier.append(grasp.subset)
        several += len(earlier) > 1
    assert several >= 3


def test_with_position_error_rho_of_soft_fingers_is_the_worst_of_all_shifts() -> None:
    """Each finger misses on its own, along either tangent, forth or back, or not at all."""
    feasible = 0
    for seed in PAIRS[:10]:
        free = replace(soft_problem(seed), wrenches=soft_problem(seed).wrenches[:2])
        problem = replace(free, position_error=0.01 * free.length)
        found = CertifiedSearch(gap=1e-4).run(problem)
        assert found.rho >= CertifiedSearch(gap=1e-4).run(free).rho * (1 - 1e-4)
        if found.incumbent is None:
            continue
        feasible += 1
        subset = found.incumbent.subset
        tangents = contact_frames(free.contacts.normals[subset])[:, :, 1:]
        moves = [0 * tangents[:, :, 0], *(sign * tangents[:, :, axis] for sign in (1, -1) for axis in (0, 1))]
        shifted = [
            free.contacts.points[subset] + problem.position_error * np.stack([moves[a][0], moves[b][1]])
            for a, b in product(range(5), repeat=2)
        ]
        members = tuple(subset.tolist())
        assert found.rho == pytest.approx(max(level(free, members, points) for points in shifted), rel=1e-4)
    assert feasible >= 4


def test_coarse_to_fine_finds_the_optimum_of_soft_fingers_when_it_certifies() -> None:
    problem = next(each for each in map(soft_problem, PAIRS) if len(every_rho(each)) > 3)
    exact = CertifiedSearch().run(problem)
    certified = CoarseToFine(coarse=4, radius=0.3, certify=True).run(problem)
    assert certified.rho == pytest.approx(exact.rho, rel=2e-3)
    assert certified.status is exact.status


def test_what_the_paper_does_not_know_is_refused_with_its_reason() -> None:
    problem = next(each for each in map(soft_problem, PAIRS) if every_rho(each))
    best = exhaustive_search(problem)
    assert best is not None
    with pytest.raises(CandidateError, match="torsional friction"):
        PaperSearch(bound="subproblem 2").run(problem)
    bounds: tuple[Bound, ...] = ("relaxation", "subproblem 2")
    for bound in bounds:
        with pytest.raises(CandidateError, match="bounds are those of hard fingers"):
            LowerBounds(problem, bound, sides=16)
    with pytest.raises(ContactError, match="tie-break sums the forces of hard ones"):
        tie_break(problem, (best,))
    with pytest.raises(CandidateError, match="hard fingers that are alike"):
        solve_as_cone_program(problem, 1e-3, 10)
    assert Evaluator(problem).evaluate(best.subset).rho == pytest.approx(best.rho)
