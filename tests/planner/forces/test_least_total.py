"""The tie-break's inner problem: closed form, CVXPY, its order against Subproblem 2, and its maximum over W_R."""

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.contacts import Contacts, grasp_maps
from planner.forces.least_total import LeastTotalForces, largest_least_total
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from tests.strategies.force_problems import SEEDS, SHAPES, random_problem
from tests.tools.lanes import first_fast

SOLVERS = {shape: LeastTotalForces(*shape) for shape in SHAPES}


def opposed(friction: float, half_width: float) -> Contacts:
    return Contacts(
        points=np.array([[-half_width, 0.0], [half_width, 0.0]]),
        normals=np.array([[1.0, 0.0], [-1.0, 0.0]]),
        friction=np.full(2, friction),
    )


def textbook_total(problem: ForceProblem) -> float:
    """min |(f_1, ..., f_m)| in the body frame as one second-order cone program."""
    contacts = problem.contacts
    scale = np.r_[np.ones(contacts.dimension), np.full(len(problem.wrench) - contacts.dimension, 1 / problem.length)]
    load = scale * problem.wrench
    unit = np.linalg.norm(load)
    forces = cp.Variable(contacts.points.shape)
    maps = scale[:, None] * grasp_maps(contacts.points, problem.reference_point)
    balance = sum(grasp_map @ forces[finger] for finger, grasp_map in enumerate(maps)) == -load / unit
    cones = []
    for finger, (normal, friction) in enumerate(zip(contacts.normals, contacts.friction, strict=True)):
        press = normal @ forces[finger]
        cones.append(cp.norm(forces[finger] - press * normal) <= friction * press)
    program = cp.Problem(cp.Minimize(cp.norm(cp.vec(forces, order="C"))), [balance, *cones])
    return float(unit * program.solve(solver="CLARABEL"))


@pytest.mark.parametrize("friction", [0.1, 0.4, 1.3])
def test_two_opposed_fingers_share_a_weight_and_a_moment_as_statics_says(friction: float) -> None:
    """Tangential forces W/2 ± M/2a; both press with the larger of them over mu."""
    half_width, weight, moment = 0.03, 5.0, 0.06
    lifts = np.array([weight / 2 + moment / (2 * half_width), weight / 2 - moment / (2 * half_width)])
    press = lifts.max() / friction
    problem = ForceProblem(
        contacts=opposed(friction, half_width),
        reference_point=np.zeros(2),
        wrench=np.array([0.0, -weight, moment]),
    )
    forces, total = SOLVERS[2, 2].solve(problem)
    assert forces == pytest.approx(np.array([[press, lifts[0]], [-press, lifts[1]]]), rel=1e-6)
    assert total == pytest.approx(np.sqrt(2 * press**2 + (lifts**2).sum()), rel=1e-7)


@pytest.mark.parametrize(("fingers", "dimension"), first_fast(SHAPES, fast=5))
def test_the_quadratic_program_agrees_with_the_textbook(fingers: int, dimension: int) -> None:
    rng = np.random.default_rng((fingers, dimension))
    for trial in range(10):
        problem = random_problem(rng, fingers, dimension, feasible=trial % 2 == 0)
        assert SOLVERS[fingers, dimension].solve(problem)[1] == pytest.approx(textbook_total(problem), rel=1e-6)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(seed=SEEDS, shape=st.sampled_from(SHAPES))
def test_the_total_lies_between_phi_and_that_of_the_minimax_forces(seed: int, shape: tuple[int, int]) -> None:
    """Its forces are a choice for phi, and those of phi are a choice for it."""
    problem = random_problem(np.random.default_rng(seed), *shape, feasible=True)
    forces, total = SOLVERS[shape].solve(problem)
    minimax = MinimaxForces(*shape).solve(problem)
    assert minimax.phi <= np.linalg.norm(forces, axis=1).max() * (1 + 1e-6)
    assert total <= np.linalg.norm(minimax.forces) * (1 + 1e-6)


def test_no_cap_holds_the_forces() -> None:
    """One finger along the load and two 60 degrees off it: equal forces need the least phi, not the least total."""
    sine = np.sqrt(0.75)
    contacts = Contacts(
        points=np.array([[0.0, -1.0], [-sine, -0.5], [sine, -0.5]]),
        normals=np.array([[0.0, 1.0], [sine, 0.5], [-sine, 0.5]]),
        friction=np.full(3, 1e-6),
    )
    problem = ForceProblem(contacts=contacts, reference_point=np.zeros(2), wrench=np.array([0.0, -6.0, 0.0]))
    forces, total = SOLVERS[3, 2].solve(problem)
    assert MinimaxForces(3, 2).solve(problem).phi == pytest.approx(3.0, rel=1e-5)
    assert np.linalg.norm(forces, axis=1) == pytest.approx([4.0, 2.0, 2.0], rel=1e-5)
    assert total == pytest.approx(np.sqrt(24), rel=1e-5)


def test_the_criterion_is_the_largest_over_the_vertices() -> None:
    contacts = opposed(0.5, 0.03)
    wrenches = np.array([[0.0, -5.0, 0.0], [0.0, 8.0, 0.0], [0.0, 2.0, 0.03]])
    assert largest_least_total(contacts, np.zeros(2), wrenches) == pytest.approx(np.sqrt(2 * 4**2 * (1 + 4)), rel=1e-7)


def test_a_grasp_that_cannot_balance_a_vertex_has_an_infinite_criterion() -> None:
    palm = Contacts(
        points=np.array([[-0.02, 0.0], [0.02, 0.0]]),
        normals=np.array([[0.0, 1.0], [0.0, 1.0]]),
        friction=np.full(2, 0.5),
    )
    wrenches = np.array([[0.0, -5.0, 0.0], [0.0, 1.0, 0.0]])
    assert np.isfinite(largest_least_total(palm, np.zeros(2), wrenches[:1]))
    assert np.isinf(largest_least_total(palm, np.zeros(2), wrenches))
