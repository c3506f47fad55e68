"""Searches under limits against enumeration that shares neither their loops nor their force problems."""

from collections.abc import Callable
from dataclasses import replace
from itertools import combinations, product

import numpy as np
import pytest

from planner.arrays import Floats, Indices
from planner.contacts import Contacts, contact_frames
from planner.errors import CandidateError, SettingError, SolverError
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.search.certified import CertifiedSearch
from planner.search.evaluation import Evaluator
from planner.search.exhaustive import exhaustive_search
from planner.search.finger_kind import FingerKind
from planner.search.paper import PaperSearch
from planner.search.problem import SearchProblem
from planner.search.result import Status
from planner.verification.bound_check import Claim, check_bound
from planner.verification.proof_check import certificate_of
from tests.strategies.limited_problems import opposite_problem, unlike_all
from tests.strategies.search_problems import random_problem

GAP = 1e-3
SEEDS = [seed for seed in range(60) if random_problem(seed).fingers == 3][:16]

FLAT = (6, 34, 36, 38)
"""Planar instances of two and three fingers, small enough for all subsets with all shifts; one is infeasible."""

Wanted = Callable[[SearchProblem, tuple[int, ...]], bool]


def force_level(problem: SearchProblem, subset: tuple[int, ...], strength: Floats, points: Floats) -> float:
    """rho of one grasp [N], from one force problem per wrench."""
    contacts = problem.contacts.subset(np.array(subset))
    contacts = Contacts(points=points, normals=contacts.normals, friction=contacts.friction, strength=strength)
    solver = MinimaxForces(problem.fingers, contacts.dimension)
    levels = []
    for wrench in problem.wrenches:
        one = ForceProblem(contacts=contacts, reference_point=problem.reference_point, wrench=wrench)
        try:
            levels.append(solver.solve(one).phi)
        except SolverError:  # neither forces nor a proof that there are none: no forces
            return np.inf
    return max(levels)


def least_level(problem: SearchProblem, wanted: Wanted) -> float:
    """rho* of the wanted subsets, by enumeration [N]; infinite if there is none."""
    subsets = [each for each in combinations(range(len(problem.contacts)), problem.fingers) if wanted(problem, each)]
    ones, points = np.ones(problem.fingers), problem.contacts.points
    return min((force_level(problem, each, ones, points[list(each)]) for each in subsets), default=np.inf)


def distances(problem: SearchProblem, subset: tuple[int, ...]) -> list[float]:
    """Of every pair of contacts [m]."""
    points = problem.contacts.points
    return [float(np.linalg.norm(points[i] - points[j])) for i, j in combinations(subset, 2)]


def assert_best(problem: SearchProblem, best: float) -> bool:
    """The search agrees with an enumerated optimum; returns whether there is one."""
    result, twin = CertifiedSearch(gap=GAP).run(problem), exhaustive_search(problem)
    if best > problem.force_ceiling:
        assert result.status is Status.INFEASIBLE
        assert twin is None
        return False
    assert result.status is Status.OPTIMAL
    assert twin is not None
    assert twin.rho == pytest.approx(best, rel=1e-6)
    assert best * (1 - 1e-6) <= result.rho <= best * (1 + GAP) * (1 + 1e-6)
    assert result.lower_bound <= best * (1 + 1e-6)
    return True


@pytest.mark.slow
def test_spacing_and_span_are_kept_and_the_best_such_grasp_is_found() -> None:
    feasible, binding = 0, 0
    for seed in SEEDS:
        free = random_problem(seed)
        usual = np.median(distances(free, tuple(range(len(free.contacts)))))
        for spacing, span in ((0.9, np.inf), (0.0, 1.2), (0.5, 1.6)):
            problem = replace(free, spacing=spacing * usual, span=span * usual)

            def wanted(problem: SearchProblem, subset: tuple[int, ...]) -> bool:
                return all(problem.spacing <= distance <= problem.span for distance in distances(problem, subset))

            best = least_level(problem, wanted)
            feasible += assert_best(problem, best)
            binding += best > 1.01 * CertifiedSearch(gap=GAP).run(free).rho
    assert feasible >= 5
    assert binding >= 5


@pytest.mark.slow
def test_fingers_of_two_kinds_take_their_own_candidates_and_never_one_point() -> None:
    """Finger 1 anywhere, fingers 2 and 3 on the last two thirds and half as strong: against all assignments."""
    feasible = 0
    for seed in SEEDS:
        free = random_problem(seed)
        count = len(free.contacts)
        rest = np.arange(count // 3, count)
        listed = np.concatenate([np.arange(count), rest])
        problem = replace(
            free,
            contacts=free.contacts.subset(listed),
            kinds=(
                FingerKind(fingers=1, candidates=count),
                FingerKind(fingers=2, candidates=len(rest), strength=0.5),
            ),
        )
        strength, points = np.array([1.0, 0.5, 0.5]), free.contacts.points
        best = min(
            force_level(free, (first, *pair), strength, points[[first, *pair]])
            for first, pair in product(range(count), combinations(rest.tolist(), 2))
            if first not in pair
        )
        feasible += assert_best(problem, best)
    assert feasible >= 4


def test_two_fingers_of_two_kinds_agree_with_all_pairs() -> None:
    """Points and their antipodes on a sphere, one finger on each: only antipodes can pull a load along any line."""
    generator = np.random.default_rng(1)
    points = generator.normal(size=(9, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points = np.concatenate([points, -points])
    contacts = Contacts(points=points, normals=-points, friction=generator.uniform(0.3, 0.9, 18))
    wrenches = np.hstack([np.concatenate([np.eye(3), -np.eye(3)]), np.zeros((6, 3))])
    free = SearchProblem(contacts=contacts, fingers=2, reference_point=np.zeros(3), wrenches=wrenches)
    problem = replace(free, kinds=(FingerKind(fingers=1, candidates=6), FingerKind(fingers=1, candidates=12)))
    best = least_level(problem, lambda _, pair: pair[0] < 6 <= pair[1])
    assert assert_best(problem, best)
    assert best > 1.01 * CertifiedSearch(gap=GAP).run(free).rho  # the kinds matter


@pytest.mark.slow
def test_pairs_whose_moment_is_zero_but_for_rounding_are_not_pruned_and_every_bound_is_proven() -> None:
    for seed in range(60):
        problem = opposite_problem(seed)
        result, best = CertifiedSearch(gap=GAP).run(problem), exhaustive_search(problem)
        assert result.rho == pytest.approx(np.inf if best is None else best.rho, rel=GAP * 1.01), seed
        bound = result.lower_bound * (1 - 1e-9)
        assert check_bound(certificate_of(result), Claim(2, problem.reference_point, problem.wrenches, bound)).proven, (
            seed
        )


@pytest.mark.slow
def test_with_position_error_rho_is_the_worst_of_all_shifts() -> None:
    feasible = 0
    for seed in FLAT:
        free = random_problem(seed)
        error = 0.03 * free.length
        problem = replace(free, position_error=error)
        tangents = free.contacts.normals[:, ::-1] * [1, -1]
        ones = np.ones(free.fingers)

        def worst(
            subset: tuple[int, ...],
            free: SearchProblem = free,
            tangents: Floats = tangents,
            error: float = error,
            ones: Floats = ones,
        ) -> float:
            points, along = free.contacts.points[list(subset)], tangents[list(subset)]
            moves = product((-error, 0.0, error), repeat=free.fingers)
            return max(force_level(free, subset, ones, points + np.array(move)[:, None] * along) for move in moves)

        best = min(map(worst, combinations(range(len(free.contacts)), free.fingers)))
        feasible += assert_best(problem, best)
    assert feasible >= 3


def test_a_position_error_in_space_never_helps_and_its_cases_cover_every_shift() -> None:
    problem = next(
        problem
        for problem in map(random_problem, range(100))
        if problem.contacts.dimension == 3 and problem.fingers == 3 and exhaustive_search(problem) is not None
    )
    missed = replace(problem, position_error=0.02 * problem.length)
    assert missed.cases == 5**3 * len(problem.wrenches)
    exact, shifted = CertifiedSearch(gap=GAP).run(problem), CertifiedSearch(gap=GAP).run(missed)
    assert shifted.rho > exact.rho * (1 + 1e-4)
    assert shifted.incumbent is not None
    subset = shifted.incumbent.subset
    assert shifted.rho == pytest.approx(Evaluator(missed).evaluate(subset).rho, rel=1e-6)
    generator = np.random.default_rng(0)
    tangents = contact_frames(problem.contacts.normals[subset])[:, :, 1:]
    for _ in range(20):  # random combinations of the shifts, made differently
        axis, sign = generator.integers(0, 2, 3), generator.choice([-1, 0, 1], 3)
        moved = problem.contacts.points[subset] + (
            missed.position_error * sign[:, None] * tangents[np.arange(3), :, axis]
        )
        level = force_level(problem, tuple(subset.tolist()), np.ones(3), moved)
        assert level <= shifted.rho * (1 + 1e-6)


@pytest.mark.slow
def test_grasps_apart_are_each_the_best_unlike_those_before() -> None:
    several = 0
    for seed in SEEDS[:10]:
        problem = random_problem(seed)
        apart = 0.6 * problem.length
        found = CertifiedSearch(gap=0.0, keep=3, apart=apart).run(problem)
        points = problem.contacts.points
        values = {
            subset: force_level(problem, subset, np.ones(3), points[list(subset)])
            for subset in combinations(range(len(points)), 3)
        }
        earlier: list[Indices] = []
        for grasp in found.grasps:
            unlike = [
                rho
                for subset, rho in values.items()
                if unlike_all(points[list(subset)], [points[each] for each in earlier], apart)
            ]
            assert grasp.rho == pytest.approx(min(unlike), rel=1e-6)
            earlier.append(grasp.subset)
        several += len(found.grasps) > 1
    assert several >= 3


def test_limits_out_of_range_are_refused() -> None:
    problem = random_problem(SEEDS[0])
    for spacing, span, error in ((-1.0, 1.0, 0.0), (0.0, 0.0, 0.0), (2.0, 1.0, 0.0), (0.0, 1.0, -1.0)):
        with pytest.raises(CandidateError):
            replace(problem, spacing=spacing, span=span, position_error=error)
    with pytest.raises(CandidateError, match="do not add up"):
        replace(problem, kinds=(FingerKind(fingers=1, candidates=2),))
    with pytest.raises(CandidateError, match="1 candidates"):
        FingerKind(fingers=2, candidates=1)
    with pytest.raises(SettingError, match="distance between grasps"):
        CertifiedSearch(apart=-1.0)
    with pytest.raises(CandidateError, match="paper's search"):
        PaperSearch().run(replace(problem, spacing=0.1))
    with pytest.raises(CandidateError, match="position errors"):
        PaperSearch().run(replace(problem, position_error=0.01))
