"""What no pair can do is never less than what the best pair does; each measure against another formula."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from planner.grasps.grasp import Certificate
from planner.search.evaluation import Evaluator
from planner.search.problem import SearchProblem
from planner.task import Task
from planner.verification.two_contacts import MOST_PAIRED, TwoContacts, loads_cancel, measure_pairs
from tests.strategies.force_problems import soft
from tests.strategies.soft_problems import soft_problem


def measured(problem: SearchProblem) -> TwoContacts:
    certificate = Certificate(
        candidates=problem.contacts, cuts=np.empty((0, 6)), kinds=problem.kinds, spacing=problem.least_distance
    )
    task = Task(name="load", reference_point=problem.reference_point, wrenches=problem.wrenches)
    pair = measure_pairs(certificate, task)
    assert pair is not None
    return pair


def pairs_of(seed: int) -> SearchProblem:
    """A random instance of two soft fingers, whose loads are all there with their opposites."""
    problem = soft_problem(seed)
    if seed % 3 == 0:  # few of these oppose each other
        slippery = replace(problem.contacts, friction=0.2 * problem.contacts.friction)
        problem = replace(problem, contacts=soft(slippery, 0.2 * slippery.torsions))
    return replace(problem, fingers=2, kinds=(), wrenches=np.vstack([problem.wrenches, -problem.wrenches]))


def least_rho(problem: SearchProblem) -> float:
    evaluator = Evaluator(problem)
    pairs = combinations(range(len(problem.contacts)), 2)
    return float(min(evaluator.evaluate(np.array(pair)).rho for pair in pairs))


@pytest.mark.parametrize("part", range(4))
def test_no_pair_does_better_than_its_measures_say(part: int) -> None:
    said, held = 0, 0
    for seed in range(30 * part, 30 * part + 30):
        problem = pairs_of(seed)
        pair, rho = measured(problem), least_rho(problem)
        assert pair.turning_force <= rho * (1 + 1e-6), seed
        if pair.lean > 1e-6:
            assert not rho < problem.force_ceiling, seed
            said += 1
        held += rho < problem.force_ceiling
    assert said >= 3 and held >= 3


def test_the_measures_of_a_pair_are_those_of_a_page_of_trigonometry() -> None:
    """Two contacts at a distance of 2 on x, the second normal turned by 0.6 rad towards y; weight at a lever of 0.2."""
    base = soft_problem(1)
    turned = np.array([[1.0, 0, 0], [-np.cos(0.6), np.sin(0.6), 0]])
    contacts = replace(
        soft(base.contacts.subset(np.arange(2)), np.array([0.01, 0.03])),
        points=np.array([[-1.0, 0, 0], [1, 0, 0]]),
        normals=turned,
        friction=np.full(2, 0.5),
    )
    wrenches = np.array([[0, 0, -1.0, 0.2, 0, 0]])
    problem = replace(base, contacts=contacts, fingers=2, kinds=(), reference_point=np.zeros(3), wrenches=wrenches)
    pair = measured(problem)
    assert pair.moment == pytest.approx(0.2)
    assert pair.turning_force == pytest.approx(0.2 / (0.01 + 0.03 * np.cos(0.6)))
    assert pair.lean == pytest.approx(0.6 - np.arctan(0.5) - np.arcsin(0.04 / 2))
    outward = replace(problem, contacts=replace(contacts, normals=-turned))
    assert measured(outward).lean == pytest.approx(pair.lean), "fingers may press apart, inside a ring"
    assert measured(replace(problem, contacts=soft(contacts, 0.0))).turning_force == np.inf


def test_pairs_that_the_limits_forbid_do_not_count() -> None:
    problem = pairs_of(3)
    free = measured(problem)
    points = problem.contacts.points
    farthest = max(np.linalg.norm(points[i] - points[j]) for i, j in combinations(range(len(points)), 2))
    certificate = Certificate(candidates=problem.contacts, cuts=np.empty((0, 6)), spacing=2 * float(farthest))
    task = Task(name="load", reference_point=problem.reference_point, wrenches=problem.wrenches)
    none = measure_pairs(certificate, task)
    assert none is not None and none.moment == np.inf and free.moment < np.inf
    many = problem.contacts.subset(np.zeros(MOST_PAIRED + 1, dtype=int))
    assert measure_pairs(Certificate(candidates=many, cuts=np.empty((0, 6))), task) is None


@pytest.mark.parametrize(
    ("loads", "cancel"),
    [
        ([[0, 0, 1], [0, 0, -3]], True),
        ([[1, 0, 0], [-0.5, 0.8, 0], [-0.5, -0.8, 0]], True),
        ([[0, 0, 0], [0, 0, 1]], False),
        ([[1, 0, 0], [0, 1, 0], [-1, 1e-3, 0]], False),
    ],
)
def test_loads_cancel_where_zero_is_among_their_mixtures(loads: list[list[float]], cancel: bool) -> None:
    forces = np.array(loads, dtype=float)
    assert loads_cancel(np.hstack([forces, 0 * forces]), 0.1) is cancel
    assert loads_cancel(np.hstack([0 * forces, 1e-4 * forces]), 0.1) is cancel
