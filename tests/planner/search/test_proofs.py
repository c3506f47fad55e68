"""Every certificate checks: its cuts prove the bound that the search claims, by code that shares nothing with it."""

from dataclasses import replace

import pytest

from planner.search.exhaustive import exhaustive_search
from planner.search.minimal_cuts import minimal_cuts
from planner.search.result import SearchResult, Status
from planner.verification.bound_check import BoundCheck, Claim, check_bound
from planner.verification.proof_check import certificate_of
from tests.strategies.small_objects import settings, small_problem

pytestmark = pytest.mark.slow

SEEDS = 200
BLOCK = 20
"""Seeds of one test."""

MOST_ENUMERATED = 500
"""Subsets up to which every one of them is evaluated."""

ACCURACY = 1e-6
"""Of the inner solver, relative."""


def checked(result: SearchResult) -> BoundCheck:
    """The verdict of the independent code."""
    problem = result.problem
    return check_bound(
        certificate_of(result), Claim(problem.fingers, problem.reference_point, problem.wrenches, result.lower_bound)
    )


def assert_best(result: SearchResult, gap: float, seed: int) -> None:
    """The result is that of enumeration."""
    best = exhaustive_search(result.problem)
    if best is None:
        assert result.status is Status.INFEASIBLE, seed
        return
    assert result.lower_bound <= best.rho * (1 + ACCURACY), seed
    assert best.rho * (1 - ACCURACY) <= result.rho <= best.rho * (1 + gap) * (1 + 2 * ACCURACY), seed


@pytest.mark.parametrize("first", range(0, SEEDS, BLOCK))
def test_every_certificate_proves_its_bound_before_and_after_thinning(first: int) -> None:
    statuses = set()
    for seed in range(first, first + BLOCK):
        search = settings(seed)
        result = search.run(small_problem(seed))
        assert checked(result).proven, seed
        assert checked(replace(result, cuts=minimal_cuts(result))).proven, seed
        assert all(result.lower_bound <= grasp.rho for grasp in result.grasps), seed
        assert result.gap <= max(search.gap, ACCURACY) or not result.grasps, seed
        if result.problem.subsets <= MOST_ENUMERATED:
            assert_best(result, search.gap, seed)
        statuses.add(result.status)
    assert statuses == {Status.OPTIMAL, Status.INFEASIBLE}, "both occur in every block"
