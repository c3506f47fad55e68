"""The certificate checker accepts what is proven and rejects what is not, however it looks."""

from dataclasses import replace
from functools import cache
from itertools import chain, repeat
from typing import Any

import numpy as np
import pytest

from planner.arrays import Floats
from planner.contact_models.friction_cone import support
from planner.contacts import grasp_maps
from planner.errors import CandidateError
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.grasps.grasp import Certificate
from planner.search.certified import CertifiedSearch
from planner.search.exhaustive import exhaustive_search
from planner.search.finger_kind import FingerKind
from planner.search.problem import SearchProblem
from planner.verification import bound_check as module
from planner.verification.bound_check import Claim, check_bound
from planner.verification.capacities import cut_values
from tests.strategies import limited_problems as limited
from tests.strategies.limited_problems import allowed, least_level, limited_problem, opposite_problem
from tests.strategies.search_problems import random_problem
from tests.tools.lanes import first_fast

SEEDS = range(60)
LIMITED = range(40)


@cache
def certified(seed: int) -> tuple[SearchProblem, Certificate, float]:
    problem = random_problem(seed)
    result = CertifiedSearch(gap=1e-4).run(problem)
    return problem, Certificate(candidates=problem.contacts, cuts=result.cuts), result.lower_bound


@cache
def best_rho(seed: int) -> float:
    """rho* of a random problem by enumeration [N], infinite where no subset holds."""
    best = exhaustive_search(random_problem(seed))
    return np.inf if best is None else best.rho


def holds(problem: SearchProblem, certificate: Certificate, bound: float) -> bool:
    return check_bound(certificate, Claim(problem.fingers, problem.reference_point, problem.wrenches, bound)).proven


def test_capacities_are_the_support_function_written_differently() -> None:
    for seed in SEEDS:
        problem = random_problem(seed)
        contacts = problem.contacts
        cuts = np.random.default_rng(seed).normal(size=(5, problem.wrenches.shape[1]))
        table = cut_values(contacts, problem.reference_point, cuts, problem.wrenches)
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
        if best_rho(seed) < np.inf:
            assert not holds(problem, certificate, best_rho(seed) * 1.001), seed


def test_a_counterexample_is_a_subset_better_than_the_claim() -> None:
    problem, certificate, bound = certified(4)
    assert best_rho(4) < np.inf
    check = check_bound(certificate, Claim(problem.fingers, problem.reference_point, problem.wrenches, 2 * bound))
    assert not check.proven
    assert len(set(check.counterexample)) == problem.fingers


@pytest.mark.parametrize("most_enumerated", [module.MOST_ENUMERATED, 0])
def test_a_check_that_is_stopped_says_the_share_it_reached_as_a_number_of_python(
    most_enumerated: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_ENUMERATED", most_enumerated)
    monkeypatch.setattr(module, "BATCH", 4)
    shares = []
    for seed in SEEDS:
        problem, certificate, bound = certified(seed)
        claim = Claim(problem.fingers, problem.reference_point, problem.wrenches, bound)
        stops = chain(repeat(False, 4), repeat(True))
        shares.append(check_bound(certificate, claim, stop=stops.__next__).share)
    assert all(type(share) is float for share in shares)
    assert any(0 < share < 1 for share in shares)


def test_no_cuts_prove_nothing() -> None:
    problem, certificate, bound = certified(4)
    none = Certificate(candidates=certificate.candidates, cuts=certificate.cuts[:0])
    assert not holds(problem, none, bound)


@pytest.mark.parametrize("most_enumerated", [module.MOST_ENUMERATED, 0])
def test_every_subset_is_settled_once(most_enumerated: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_ENUMERATED", most_enumerated)
    for problem, (certificate, bound) in [
        *((problem, (certificate, bound)) for problem, certificate, bound in map(certified, SEEDS)),
        *((limited_problem(seed), limited.certified(seed)) for seed in LIMITED),
    ]:
        if problem.fingers == 2 and problem.contacts.dimension == 3:
            continue  # pairs in space are not counted: they take no time
        settled: list[float] = []
        check_bound(
            certificate,
            Claim(problem.fingers, problem.reference_point, problem.wrenches, bound),
            observe=settled.append,
        )
        assert settled == sorted(settled)
        assert settled[-1] == problem.subsets == certificate.subsets(problem.fingers)


@pytest.mark.slow
@pytest.mark.parametrize("most_enumerated", [module.MOST_ENUMERATED, 0])
def test_under_limits_a_proven_bound_is_accepted_and_a_larger_one_is_not(
    most_enumerated: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The optimum is that of brute force with an independent solver; the counterexample itself keeps the limits."""
    monkeypatch.setattr(module, "MOST_ENUMERATED", most_enumerated)
    refuted = 0
    for seed in LIMITED:
        problem = limited_problem(seed)
        certificate, bound = limited.certified(seed)
        assert holds(problem, certificate, bound)
        best = best_level(seed)
        assert bound <= best * (1 + 1e-6)
        if best < problem.force_ceiling:
            check = check_bound(
                certificate, Claim(problem.fingers, problem.reference_point, problem.wrenches, best * (1 + 1e-3))
            )
            assert not check.proven
            assert allowed(problem, check.counterexample)
            refuted += 1
    assert refuted >= 15


@cache
def best_level(seed: int) -> float:
    """rho* of a limited problem by brute force with CVXPY [N]."""
    return least_level(limited_problem(seed))


@pytest.mark.parametrize(
    ("relaxed", "least"),
    first_fast([({"spacing": 0.0}, 4), ({"span": np.inf}, 4), ({"kinds": ()}, 4), ({"strength": 1.5}, 4)]),
    ids=["spacing", "span", "kinds", "strength"],
)
def test_a_certificate_that_claims_looser_limits_fails_where_they_allow_a_better_grasp(
    relaxed: dict[str, Any], least: int
) -> None:
    failed = 0
    for seed in LIMITED:
        problem = limited_problem(seed)
        if problem.fingers == 2 and problem.contacts.dimension == 3:
            continue  # none of them is feasible
        certificate, bound = limited.certified(seed)
        looser = stronger(problem) if "strength" in relaxed else replace(problem, **relaxed)
        if least_level(looser, MinimaxForces) < bound * (1 - 1e-3):
            tampered = replace(certificate, kinds=looser.kinds, spacing=looser.least_distance, span=looser.span)
            assert not holds(looser, tampered, bound)
            failed += 1
    assert failed >= least


def stronger(problem: SearchProblem) -> SearchProblem:
    """The same with the first kind of fingers half again as strong; all of them where there are no kinds."""
    first, *others = problem.all_kinds
    return replace(problem, kinds=(replace(first, strength=1.5 * first.strength), *others))


def opposite_pairs(problem: SearchProblem) -> tuple[float, Floats]:
    """Least rho of the pairs on opposite points [N], and the direction that proves each one's, shape (pairs, D)."""
    solver, least, directions = ReferenceForces(2, 3), np.inf, []
    contacts = replace(problem.contacts, strength=problem.strengths)
    for pair in ((i, i + 5) for i in range(5)):
        if allowed(problem, pair):
            grasp = contacts.subset(np.array(pair))
            solutions = [
                solver.solve(ForceProblem(contacts=grasp, reference_point=problem.reference_point, wrench=wrench))
                for wrench in problem.wrenches
            ]
            worst = max(solutions, key=lambda solution: solution.phi)
            least = min(least, worst.phi)
            directions.append(worst.direction)
    return least, np.array(directions)


@pytest.mark.slow
def test_of_two_fingers_in_space_exactly_the_pairs_that_can_hold_need_cuts() -> None:
    """No contact is strong along a line through both; the moments of opposite pairs are zero but for rounding."""
    looser_is_better = 0
    for problem in map(opposite_problem, range(30)):
        rho, cuts = opposite_pairs(problem)
        certificate = Certificate(
            candidates=problem.contacts, cuts=cuts, kinds=problem.kinds, spacing=problem.spacing, span=problem.span
        )
        assert holds(problem, certificate, rho * (1 - 1e-5))
        assert not holds(problem, certificate, rho * (1 + 1e-5))
        free = replace(problem, spacing=0.0, span=np.inf, kinds=())
        if opposite_pairs(free)[0] < rho * (1 - 1e-3):
            looser = replace(certificate, spacing=0.0, span=np.inf, kinds=())
            assert not holds(free, looser, rho * (1 - 1e-5))
            looser_is_better += 1
    assert looser_is_better >= 10


def test_two_fingers_of_two_kinds_never_take_two_candidates_of_one() -> None:
    """Opposite points, which alone can hold, are of one kind here; so without a single cut nothing is needed."""
    kinds = FingerKind(fingers=1, candidates=6), FingerKind(fingers=1, candidates=4)
    for problem in map(opposite_problem, range(10)):
        contacts = problem.contacts.subset(np.array([0, 5, 1, 6, 2, 7, 3, 8, 4, 9]))
        certificate = Certificate(candidates=contacts, cuts=np.empty((0, 6)), kinds=kinds)
        assert holds(problem, certificate, 1e4)
        assert not holds(problem, replace(certificate, kinds=()), 1e4)


@pytest.mark.parametrize("most_enumerated", [module.MOST_ENUMERATED, 0])
def test_coinciding_candidates_are_told_apart(most_enumerated: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Groups that cannot be split by position: by count, down to single candidates."""
    monkeypatch.setattr(module, "MOST_ENUMERATED", most_enumerated)
    problem, certificate, bound = certified(4)
    repeated = problem.contacts.subset(np.repeat(np.arange(len(problem.contacts)), 3))
    many = Certificate(candidates=repeated, cuts=certificate.cuts)
    check = check_bound(many, Claim(problem.fingers, problem.reference_point, problem.wrenches, 3 * bound))
    assert not check.proven
    assert len(set(check.counterexample)) == problem.fingers


def test_kinds_that_do_not_add_up_are_refused() -> None:
    problem, certificate, bound = certified(4)
    count = len(problem.contacts)
    with pytest.raises(CandidateError, match="kinds of fingers for 3 candidates, of which there are"):
        replace(certificate, kinds=(FingerKind(fingers=1, candidates=3),))
    with pytest.raises(CandidateError, match="do not add up"):
        holds(problem, replace(certificate, kinds=(FingerKind(fingers=1, candidates=count),)), bound)
    with pytest.raises(CandidateError, match="least distance"):
        replace(certificate, spacing=2.0, span=1.0)
