"""The certificate checker accepts what is proven and rejects what is not, however it looks."""

import numpy as np
import pytest

from planner import certificate as module
from planner.certificate import capacities, check_bound
from planner.contacts import grasp_maps
from planner.friction_cone import support
from planner.grasp import Certificate
from planner.search.certified import CertifiedSearch
from planner.search.exhaustive import exhaustive_search
from planner.search.problem import SearchProblem
from tests.planner.search.instances import random_problem

SEEDS = range(60)


def certified(seed: int) -> tuple[SearchProblem, Certificate, float]:
    problem = random_problem(seed)
    result = CertifiedSearch(gap=1e-4).run(problem)
    return problem, Certificate(candidates=problem.contacts, cuts=result.directions), result.lower_bound


def holds(problem: SearchProblem, certificate: Certificate, bound: float) -> bool:
    return check_bound(certificate, problem.fingers, problem.reference_point, problem.wrenches, bound).proven


def test_capacities_are_the_support_function_written_differently() -> None:
    for seed in SEEDS:
        problem = random_problem(seed)
        contacts = problem.contacts
        cuts = np.random.default_rng(seed).normal(size=(5, problem.wrenches.shape[1]))
        table = capacities(
            contacts.points - problem.reference_point, contacts.normals, contacts.friction, cuts, problem.wrenches
        )
        maps = grasp_maps(contacts.points, problem.reference_point)
        for k, cut in enumerate(cuts):
            asked = (-problem.wrenches @ cut).max()
            if asked <= 0:
                assert np.isinf(table[:, k]).all()
                continue
            expected = support(maps.transpose(0, 2, 1) @ cut, contacts.normals, contacts.friction) / asked
            np.testing.assert_allclose(table[:, k], expected, rtol=1e-9, atol=1e-12 * expected.max())


@pytest.mark.parametrize("most_enumerated", [module.MOST_ENUMERATED, 0])
def test_a_proven_bound_is_accepted_and_a_larger_one_is_not(
    most_enumerated: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_ENUMERATED", most_enumerated)
    for seed in SEEDS:
        problem, certificate, bound = certified(seed)
        assert holds(problem, certificate, bound), seed
        best = exhaustive_search(problem)
        if best is not None:
            assert not holds(problem, certificate, best.rho * 1.001), seed


def test_a_counterexample_is_a_subset_better_than_the_claim() -> None:
    problem, certificate, bound = certified(4)
    best = exhaustive_search(problem)
    assert best is not None
    check = check_bound(certificate, problem.fingers, problem.reference_point, problem.wrenches, 2 * bound)
    assert not check.proven
    assert len(set(check.counterexample)) == problem.fingers


def test_no_cuts_prove_nothing() -> None:
    problem, certificate, bound = certified(4)
    none = Certificate(candidates=certificate.candidates, cuts=certificate.cuts[:0])
    assert not holds(problem, none, bound)
