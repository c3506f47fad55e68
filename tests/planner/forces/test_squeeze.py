"""The predicted need of a passive squeeze: a pencil, another formulation, and what it must never be."""

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.arrays import Floats
from planner.contact_models.friction_cone import utilisation
from planner.contacts import Contacts, grasp_maps
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.forces.squeeze import squeeze_need

SEEDS = st.integers(0, 2**32 - 1)
ORIGIN = np.zeros(3)


def opposed(friction: float) -> Contacts:
    """Two fingers that press a body between x = -1 and x = 1."""
    points = np.array([(-1.0, 0, 0), (1, 0, 0)])
    return Contacts(points=points, normals=-points, friction=np.full(2, friction))


def grasp_and_wrenches(seed: int, wrenches: int = 4) -> tuple[Contacts, Floats, Floats]:
    """Random fingers about a ball, a reference point and a few wrenches, often on one side of the origin."""
    rng = np.random.default_rng(seed)
    fingers = int(rng.integers(3, 7))
    points = rng.normal(size=(fingers, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    contacts = Contacts(points=points, normals=-points, friction=rng.uniform(0.3, 1.2, size=fingers))
    return contacts, 0.3 * rng.normal(size=3), rng.normal(size=(wrenches, 6)) + rng.normal(size=6)


@pytest.mark.parametrize("friction", [0.2, 0.5, 1.5])
def test_two_opposed_fingers_hold_a_weight_with_a_preload_of_weight_over_twice_the_friction(friction: float) -> None:
    weight = 3.0
    need = squeeze_need(opposed(friction), ORIGIN, np.array([[0, 0, -weight, 0, 0, 0]]))
    press = weight / (2 * friction)
    np.testing.assert_allclose(need.preload, press * opposed(friction).normals, atol=1e-6)
    assert need.squeeze_force == pytest.approx(np.hypot(press, weight / 2), rel=1e-6)
    np.testing.assert_allclose(need.forces[0][:, 2], weight / 2, rtol=1e-6)


def test_a_push_along_the_line_of_two_fingers_is_shared_by_both() -> None:
    need = squeeze_need(opposed(0.5), ORIGIN, np.array([[2.0, 0, 0, 0, 0, 0], [-2.0, 0, 0, 0, 0, 0]]))
    assert need.squeeze_force == pytest.approx(2.0, rel=1e-6)  # 1 N of preload, 1 N more or less of spring


@settings(max_examples=8, deadline=None)
@given(seed=SEEDS, stiffness=st.floats(0.5, 2.0), count=st.sampled_from([1, 4, 16]))
@pytest.mark.slow
def test_springs_about_a_moving_body_written_out_give_the_same_need(seed: int, stiffness: float, count: int) -> None:
    contacts, reference_point, wrenches = grasp_and_wrenches(seed, count)
    need = squeeze_need(contacts, reference_point, wrenches)
    expected = springs_written_out(contacts, reference_point, wrenches, stiffness)
    assert need.feasible == np.isfinite(expected)
    if need.feasible:
        assert need.squeeze_force == pytest.approx(expected, rel=1e-5)


def springs_written_out(contacts: Contacts, reference_point: Floats, wrenches: Floats, K: float) -> float:
    """Least largest force with the twist of the object a variable of every wrench, in the body frame."""
    maps = grasp_maps(contacts.points, reference_point)
    preloads, cap = [cp.Variable(3) for _ in maps], cp.Variable()
    constraints = [sum(G @ p for G, p in zip(maps, preloads, strict=True)) == 0]
    for wrench in [np.zeros(6), *wrenches]:
        twist = cp.Variable(6)
        forces = [p - K * G.T @ twist for G, p in zip(maps, preloads, strict=True)]
        constraints.append(sum(G @ f for G, f in zip(maps, forces, strict=True)) == -wrench)
        for force, normal, friction in zip(forces, contacts.normals, contacts.friction, strict=True):
            constraints.append(cp.norm(force - normal * (normal @ force)) <= friction * (normal @ force))
            constraints.append(cp.norm(force) <= cap)
    return float(cp.Problem(cp.Minimize(cap), constraints).solve(solver="CLARABEL"))


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS)
def test_fingers_that_do_not_adapt_never_need_less_than_rho(seed: int) -> None:
    contacts, reference_point, wrenches = grasp_and_wrenches(seed)
    solver = MinimaxForces(len(contacts), 3)
    problems = [ForceProblem(contacts=contacts, reference_point=reference_point, wrench=wrench) for wrench in wrenches]
    rho = max(solver.solve(problem).phi for problem in problems)
    assert squeeze_need(contacts, reference_point, wrenches).squeeze_force >= rho * (1 - 1e-6)


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, more=st.floats(0.0, 3.0), part=st.floats(0.0, 1.0))
def test_a_stronger_preload_holds_every_part_of_every_wrench(seed: int, more: float, part: float) -> None:
    contacts, reference_point, wrenches = grasp_and_wrenches(seed)
    need = squeeze_need(contacts, reference_point, wrenches)
    assume(need.feasible)
    forces = (1 + more) * need.preload + part * (need.forces - need.preload)
    maps = grasp_maps(contacts.points, reference_point)
    np.testing.assert_allclose(np.einsum("iDd,jid->jD", maps, forces), -part * wrenches, atol=1e-6 * need.squeeze_force)
    norms = np.linalg.norm(forces, axis=2)
    assert norms.max() <= (1 + more) * need.squeeze_force * (1 + 1e-6)
    loaded = norms > 1e-3 * need.squeeze_force
    assert (utilisation(forces, contacts.normals) <= contacts.friction * (1 + 1e-3))[loaded].all()


def test_a_moment_about_the_line_of_two_fingers_is_out_of_their_reach() -> None:
    need = squeeze_need(opposed(0.5), ORIGIN, np.array([[0, 0, 0, 1.0, 0, 0]]))
    assert not need.feasible and np.isinf(need.squeeze_force) and np.isnan(need.preload).all()


def test_fingers_that_only_support_hold_a_weight_but_not_a_lift() -> None:
    points = np.array([(1.0, 0, -1), (-0.5, np.sqrt(0.75), -1), (-0.5, -np.sqrt(0.75), -1)])
    below = Contacts(points=points, normals=np.tile([0.0, 0, 1], (3, 1)), friction=np.full(3, 0.5))
    weight = np.array([[0, 0, -3.0, 0, 0, 0]])
    assert squeeze_need(below, ORIGIN, weight).squeeze_force == pytest.approx(1.0, rel=1e-6)
    assert not squeeze_need(below, ORIGIN, -weight).feasible


def test_in_the_plane_the_same_weight_needs_the_same_squeeze() -> None:
    points = np.array([(-1.0, 0), (1, 0)])
    planar = Contacts(points=points, normals=-points, friction=np.full(2, 0.5))
    need = squeeze_need(planar, np.zeros(2), np.array([[0, -3.0, 0]]))
    assert need.squeeze_force == pytest.approx(np.hypot(3.0, 1.5), rel=1e-6)


def test_no_wrench_needs_no_squeeze() -> None:
    assert squeeze_need(opposed(0.5), ORIGIN, np.zeros((1, 6))).squeeze_force == 0.0
