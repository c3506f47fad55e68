"""The k best, all within a tolerance, the tie-break and the coarse-to-fine heuristic, against enumeration."""

from itertools import combinations

import numpy as np
import pytest

from planner.forces.least_total import largest_least_total
from planner.grasps.grasp import Grasp
from planner.search.certified import CertifiedSearch
from planner.search.coarse_to_fine import CoarseToFine
from planner.search.evaluation import Evaluator
from planner.search.problem import SearchProblem
from planner.search.result import Status
from planner.search.tie_break import tie_break
from tests.strategies.search_problems import random_problem

SEEDS = range(400, 430)


def every_rho(problem: SearchProblem) -> dict[tuple[int, ...], float]:
    """rho of all subsets that resist the task."""
    evaluator = Evaluator(problem)
    subsets = combinations(range(len(problem.contacts)), problem.fingers)
    rho = {subset: evaluator.evaluate(np.array(subset)).rho for subset in subsets}
    return {subset: value for subset, value in rho.items() if value < problem.force_ceiling}


def test_all_grasps_within_a_tolerance_are_found_and_no_others() -> None:
    several = 0
    for seed in SEEDS:
        problem = random_problem(seed)
        rho = every_rho(problem)
        result = CertifiedSearch(within=0.3, keep=10_000).run(problem)
        found = {tuple(grasp.subset.tolist()) for grasp in result.grasps}
        if not rho:
            assert not found
            continue
        best = min(rho.values())
        assert {s for s, value in rho.items() if value <= 1.2999 * best} <= found, seed
        assert found <= {s for s, value in rho.items() if value <= 1.3001 * best}, seed
        several += len(found) > 1
    assert several > 3


@pytest.mark.slow
def test_the_k_best_are_the_k_best() -> None:
    for seed in SEEDS:
        problem = random_problem(seed)
        rho = sorted(every_rho(problem).values())
        result = CertifiedSearch(keep=4, gap=0.0).run(problem)
        np.testing.assert_allclose([grasp.rho for grasp in result.grasps], rho[:4], rtol=1e-5)


def golden_problem(golden_grasp: Grasp) -> SearchProblem:
    return SearchProblem(
        contacts=golden_grasp.certificate.candidates,
        fingers=3,
        reference_point=golden_grasp.task.reference_point,
        wrenches=golden_grasp.task.wrenches,
    )


def test_the_papers_optimum_is_unique_but_for_its_mirror_image(golden_grasp: Grasp) -> None:
    problem = golden_problem(golden_grasp)
    result = CertifiedSearch(within=1e-4, keep=100).run(problem)
    assert result.status is Status.OPTIMAL
    chosen, criterion = tie_break(problem, result.grasps)
    points = 100 * problem.contacts.points[chosen.subset]
    expected = {(2 / 9, -4 / 3, 0.0), (2 / 3, 2 / 3, 0.0), (-4 / 3, 2 / 9, 0.0)}
    assert {tuple(np.round(point, 6)) for point in points} == {tuple(np.round(point, 6)) for point in expected}
    assert criterion == pytest.approx(
        largest_least_total(problem.contacts.subset(chosen.subset), problem.reference_point, problem.wrenches)
    )


@pytest.mark.slow
def test_the_tie_break_prefers_the_smaller_criterion(golden_grasp: Grasp) -> None:
    problem = golden_problem(golden_grasp)
    grasps = CertifiedSearch(keep=6).run(problem).grasps
    criteria = [
        largest_least_total(problem.contacts.subset(grasp.subset), problem.reference_point, problem.wrenches)
        for grasp in grasps
    ]
    chosen, criterion = tie_break(problem, grasps)
    assert criterion == pytest.approx(min(criteria), rel=1e-6)
    assert max(criteria) > min(criteria) * 1.001  # there was something to prefer
    assert any(np.array_equal(chosen.subset, grasp.subset) for grasp in grasps)


def test_coarse_to_fine_is_honest_and_certifies_when_asked(golden_grasp: Grasp) -> None:
    problem = golden_problem(golden_grasp)
    rough = CoarseToFine().run(problem)
    assert rough.status is Status.HEURISTIC
    assert rough.lower_bound == 0
    assert np.isinf(rough.gap)
    assert golden_grasp.rho * (1 - 1e-6) <= rough.rho <= 1.1 * golden_grasp.rho
    certified = CoarseToFine(coarse=40, radius=0.1, certify=True).run(problem)
    assert certified.status is Status.OPTIMAL
    assert certified.gap <= 1e-3
    assert certified.rho == pytest.approx(golden_grasp.rho, rel=1e-3)


@pytest.mark.slow
def test_coarse_to_fine_looks_harder_when_the_coarse_candidates_hold_no_grasp() -> None:
    for seed in SEEDS:
        problem = random_problem(seed)
        exact = CertifiedSearch().run(problem)
        rough = CoarseToFine(coarse=1, radius=10.0).run(problem)
        assert (rough.incumbent is None) == (exact.incumbent is None), seed
