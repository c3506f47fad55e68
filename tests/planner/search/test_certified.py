"""The certified search against enumeration, and against its own promises."""

from itertools import chain, combinations, repeat

import numpy as np
import pytest

from planner.contact_models.friction_cone import support
from planner.contacts import grasp_maps
from planner.search.certified import CertifiedSearch
from planner.search.exhaustive import exhaustive_search
from planner.search.problem import SearchProblem
from planner.search.result import SearchResult, Status
from tests.strategies.search_problems import random_problem
from tests.tools.lanes import first_fast

GAP = 1e-3
SEEDS = range(240)


def proven_bound(result: SearchResult) -> float:
    """Lower bound on rho* that the returned directions prove, by enumeration."""
    problem = result.problem
    contacts = problem.contacts
    maps = grasp_maps(contacts.points, problem.reference_point)
    weakest = 0.0
    tables = []
    for direction in result.cuts:
        load = max(-direction @ wrench for wrench in problem.wrenches)
        tables.append(support(maps.transpose(0, 2, 1) @ direction, contacts.normals, contacts.friction) / load)
    for subset in combinations(range(len(contacts)), problem.fingers):
        if problem.fingers == 2 and problem.contacts.dimension == 3 and has_moment_about_line(problem, subset):
            continue
        weakest = max(weakest, min(table[list(subset)].sum() for table in tables))
    return 1 / weakest if weakest > 0 else np.inf


def has_moment_about_line(problem: SearchProblem, pair: tuple[int, ...]) -> bool:
    """Whether W_R asks for a moment about the line through two contacts, which they cannot give."""
    first, second = problem.contacts.points[list(pair)]
    line = (second - first) / np.linalg.norm(second - first)
    moments = [line @ (w[3:] - np.cross(first - problem.reference_point, w[:3])) for w in problem.wrenches]
    return max(map(abs, moments)) > 1e-9


@pytest.mark.parametrize("first", first_fast(range(0, len(SEEDS), 40)))
def test_search_agrees_with_enumeration_and_its_cuts_prove_the_bound(first: int) -> None:
    feasible = 0
    for seed in SEEDS[first : first + 40]:
        problem = random_problem(seed)
        result = CertifiedSearch(gap=GAP).run(problem)
        best = exhaustive_search(problem)
        if best is None:
            assert result.status is Status.INFEASIBLE, seed
            assert result.incumbent is None
            assert proven_bound(result) >= 0.999 * problem.force_ceiling
            continue
        feasible += 1
        assert result.status is Status.OPTIMAL, seed
        assert result.rho <= best.rho * (1 + GAP) * (1 + 1e-7), seed
        assert result.rho >= best.rho * (1 - 1e-7), seed
        assert result.lower_bound <= best.rho * (1 + 1e-7), seed
        assert result.gap <= GAP
        assert proven_bound(result) >= result.lower_bound * (1 - 1e-9), seed
    assert 5 <= feasible <= 38  # both kinds were met


def test_zero_gap_finds_the_optimum_exactly() -> None:
    for seed in (1, 2, 3, 5, 8, 13):
        problem = random_problem(seed)
        best = exhaustive_search(problem)
        result = CertifiedSearch(gap=0.0).run(problem)
        assert result.rho == pytest.approx(np.inf if best is None else best.rho, rel=1e-7)
        assert result.gap < 1e-6 or best is None


def test_wherever_it_is_stopped_its_bound_and_gap_are_true() -> None:
    stopped = 0
    for seed in (1, 2, 5, 8, 13, 21):
        problem = random_problem(seed)
        best = exhaustive_search(problem)
        for patience in (0, 1, 3, 10, 30, 60, 100):
            answers = chain(repeat(False, patience), repeat(True))
            result = CertifiedSearch().run(problem, stop=answers.__next__)
            stopped += result.status is Status.INTERRUPTED
            assert best is None or result.lower_bound <= best.rho * (1 + 1e-7)
            assert best is None or result.rho >= best.rho * (1 - 1e-7)
            if result.status is not Status.INTERRUPTED:
                assert result.status in (Status.OPTIMAL, Status.INFEASIBLE)
    assert stopped > 10
