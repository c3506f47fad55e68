"""Two hard fingers in space: grasps come as the pairs are looked at, and pairs are never all in memory."""

import tracemalloc

import numpy as np
import pytest

from planner.contacts import Contacts
from planner.search.certified import CertifiedSearch
from planner.search.evaluation import Evaluator
from planner.search.problem import SearchProblem
from planner.search.result import Progress, Status
from planner.verification.bound_check import Claim, check_bound
from planner.verification.proof_check import certificate_of

pytestmark = pytest.mark.slow


def ball(pairs: int) -> SearchProblem:
    """Points on a ball, the antipode of each somewhere among them; only antipodes can resist a force on the centre."""
    generator = np.random.default_rng(pairs)
    points = generator.normal(size=(pairs, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points = generator.permutation(np.concatenate([points, -points]))
    forces = np.concatenate([np.eye(3), -np.eye(3)])
    return SearchProblem(
        contacts=Contacts(points=points, normals=-points, friction=generator.uniform(0.5, 1.5, 2 * pairs)),
        fingers=2,
        reference_point=np.zeros(3),
        wrenches=np.hstack([forces, np.zeros((6, 3))]),
    )


def rim(count: int) -> SearchProblem:
    """Points on a circle, forces in its plane: no line through two of them sees a moment, so that all pairs may do."""
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    points = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    forces = np.concatenate([np.eye(3)[:2], -np.eye(3)[:2]])
    return SearchProblem(
        contacts=Contacts(points=points, normals=-points, friction=np.full(count, 0.7)),
        fingers=2,
        reference_point=np.zeros(3),
        wrenches=np.hstack([forces, np.zeros((4, 3))]),
    )


def test_the_first_grasp_comes_long_before_all_pairs_are_bounded() -> None:
    problem, seen = ball(1000), list[Progress]()
    result = CertifiedSearch().run(problem, seen.append, lambda: bool(seen) and seen[-1].incumbent < np.inf)
    assert result.status is Status.INTERRUPTED
    assert result.incumbent is not None
    assert result.trace[-1].nodes < 0.01 * problem.subsets
    assert result.lower_bound <= result.rho


def test_the_best_of_all_pairs_is_found_and_proven() -> None:
    problem = ball(200)
    result = CertifiedSearch().run(problem)
    antipodes = enumerate((problem.contacts.points @ problem.contacts.points.T).argmin(axis=1).tolist())
    best = min(Evaluator(problem).evaluate(np.array(pair)).rho for pair in antipodes)
    assert result.status is Status.OPTIMAL
    assert best * (1 - 1e-6) <= result.rho <= best * 1.001
    certificate = certificate_of(result)
    assert check_bound(certificate, Claim(2, problem.reference_point, problem.wrenches, result.lower_bound)).proven


def test_pairs_that_no_moment_excludes_are_not_kept_in_memory() -> None:
    problem = rim(2000)
    CertifiedSearch().run(rim(20))  # compiles
    tracemalloc.start()
    try:
        result = CertifiedSearch(gap=0.01).run(problem)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert result.status is Status.OPTIMAL
    assert result.trace[-1].nodes == problem.subsets
    assert peak < 0.8 * 16 * problem.subsets, "two whole numbers for each pair"
