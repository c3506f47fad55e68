"""The paper's branch and bound against enumeration."""

import numpy as np
import pytest

from planner.errors import CandidateError
from planner.grasps.grasp import Grasp
from planner.search.certified import CertifiedSearch
from planner.search.exhaustive import exhaustive_search
from planner.search.lower_bounds import Bound
from planner.search.paper import PaperSearch, all_subsets
from planner.search.problem import SearchProblem
from planner.search.result import Status
from tests.strategies.search_problems import random_problem
from tests.tools.lanes import first_fast


@pytest.mark.parametrize("bound", first_fast(["relaxation", "subproblem 2"]))
def test_both_bounds_agree_with_enumeration(bound: Bound) -> None:
    feasible = 0
    for seed in range(300, 340):
        problem = random_problem(seed)
        result = PaperSearch(bound=bound, epsilon=1e-4).run(problem)
        best = exhaustive_search(problem)
        if best is None:
            assert result.status is Status.INFEASIBLE
            continue
        feasible += 1
        assert result.status is Status.OPTIMAL
        assert best.rho * (1 - 1e-7) <= result.rho <= best.rho * (1 + 2e-4), seed
        assert result.lower_bound <= best.rho * (1 + 1e-7)
        assert result.trace[-1].nodes <= problem.subsets
    assert 5 < feasible < 40


def test_all_subsets_are_the_combinations() -> None:
    subsets = all_subsets(7, 3)
    assert len({tuple(subset) for subset in subsets.tolist()}) == 35
    assert (np.diff(subsets, axis=1) > 0).all()


def test_a_list_too_long_for_memory_is_refused() -> None:
    problem = random_problem(1)
    many = problem.contacts.subset(np.resize(np.arange(len(problem.contacts)), 5000))
    huge = type(problem)(contacts=many, fingers=4, reference_point=problem.reference_point, wrenches=problem.wrenches)
    with pytest.raises(CandidateError, match="certified search"):
        PaperSearch().run(huge)


@pytest.mark.slow
def test_all_searches_agree_with_enumeration_on_a_reduced_case_3(golden_grasp: Grasp) -> None:
    kept = np.union1d(np.arange(0, 217, 11), golden_grasp.chosen)
    problem = SearchProblem(
        contacts=golden_grasp.certificate.candidates.subset(kept),
        fingers=3,
        reference_point=golden_grasp.task.reference_point,
        wrenches=golden_grasp.task.wrenches,
    )
    best = exhaustive_search(problem)
    assert best is not None
    for search in (PaperSearch(), PaperSearch(bound="subproblem 2"), CertifiedSearch()):
        result = search.run(problem)
        assert result.rho == pytest.approx(best.rho, rel=1e-3)
        assert result.lower_bound <= best.rho * (1 + 1e-7)
        assert kept[result.grasps[0].subset].tolist() == sorted(golden_grasp.chosen.tolist())
