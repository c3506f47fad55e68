"""Feed-forward forces balance, respect the cap and lean on friction as little as possible."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.contact_models.friction_cone import utilisation
from planner.contacts import Contacts, grasp_maps
from sim.trial.feed_forward import CAP_TOLERANCE, FeedForward
from tests.strategies.grasps_and_wrenches import ORIGIN, grasp_and_wrench

SEEDS = st.integers(0, 2**32 - 1)


def opposed(friction: float = 0.5) -> Contacts:
    """Two fingers that press a body between x = -1 and x = 1."""
    points = np.array([(-1.0, 0, 0), (1, 0, 0)])
    return Contacts(points=points, normals=-points, friction=np.full(2, friction))


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, spare=st.floats(1e-3, 3.0))
def test_above_phi_the_forces_balance_within_the_cap_and_inside_the_cones(seed: int, spare: float) -> None:
    contacts, wrench, phi = grasp_and_wrench(seed)
    assume(np.isfinite(phi))
    cap = (1 + spare) * phi
    forces = FeedForward(contacts, ORIGIN).answer(wrench, cap).forces
    residual = np.einsum("iDd,id->D", grasp_maps(contacts.points, ORIGIN), forces) + wrench
    assert np.abs(residual).max() < 1e-6 * cap
    assert np.linalg.norm(forces, axis=1).max() <= cap * (1 + 1e-9)
    loaded = np.linalg.norm(forces, axis=1) > 1e-4 * cap
    assert (utilisation(forces, contacts.normals) <= contacts.friction * (1 + 1e-5))[loaded].all()


@settings(max_examples=20, deadline=None)
@given(seed=SEEDS)
def test_below_phi_no_forces_within_the_cap_stay_in_the_cones(seed: int) -> None:
    contacts, wrench, phi = grasp_and_wrench(seed)
    assume(np.isfinite(phi))
    forces = FeedForward(contacts, ORIGIN).answer(wrench, 0.99 * phi).forces
    residual = np.einsum("iDd,id->D", grasp_maps(contacts.points, ORIGIN), forces) + wrench
    leaves_a_cone = (utilisation(forces, contacts.normals) > contacts.friction).any()
    assert leaves_a_cone or np.abs(residual).max() > 1e-3 * phi


@settings(max_examples=10, deadline=None)
@given(seed=SEEDS, factor=st.floats(0.3, 3.0))
def test_the_level_of_friction_never_reaches_the_fingers(seed: int, factor: float) -> None:
    contacts, wrench, _ = grasp_and_wrench(seed)
    other = Contacts(points=contacts.points, normals=contacts.normals, friction=factor * contacts.friction)
    cap = float(np.abs(wrench).max())
    expected = FeedForward(contacts, ORIGIN).answer(wrench, cap).forces
    found = FeedForward(other, ORIGIN).answer(wrench, cap).forces
    np.testing.assert_allclose(found, expected, atol=CAP_TOLERANCE * cap)


@pytest.mark.parametrize("cap", [0.6, 1.0, 5.0])
def test_two_opposed_fingers_carry_a_weight_with_the_slope_of_pythagoras(cap: float) -> None:
    forces = FeedForward(opposed(), ORIGIN).answer(np.array([0, 0, -1.0, 0, 0, 0]), cap).forces
    slope = 0.5 / np.sqrt(cap**2 - 0.25)
    np.testing.assert_allclose(utilisation(forces, opposed().normals), slope, rtol=1e-3)


def test_a_weight_that_no_friction_can_hold_gets_forces_at_the_cap() -> None:
    forces = FeedForward(opposed(), ORIGIN).answer(np.array([0, 0, -1.0, 0, 0, 0]), 0.4).forces
    np.testing.assert_allclose(np.linalg.norm(forces, axis=1), 0.4, rtol=1e-6)


def test_a_moment_that_no_force_can_hold_gets_no_force() -> None:
    forces = FeedForward(opposed(), ORIGIN).answer(np.array([0, 0, 0, 1.0, 0, 0]), 1.0).forces
    np.testing.assert_array_equal(forces, 0.0)


@settings(max_examples=30, deadline=None)
@given(seed=SEEDS)
def test_the_internal_force_balances_itself_and_reaches_the_cap(seed: int) -> None:
    contacts, _, _ = grasp_and_wrench(seed)
    forces = FeedForward(contacts, ORIGIN).squeeze(0.5).forces
    largest = np.linalg.norm(forces, axis=1).max()
    assert np.abs(np.einsum("iDd,id->D", grasp_maps(contacts.points, ORIGIN), forces)).max() < 1e-6
    assert largest == 0 or largest == pytest.approx(0.5)


def test_opposed_fingers_squeeze_along_their_line() -> None:
    forces = FeedForward(opposed(), ORIGIN).squeeze(2.0).forces
    np.testing.assert_allclose(forces, 2.0 * opposed().normals, atol=1e-9)


def test_fingers_that_only_support_do_not_squeeze() -> None:
    points = np.array([(1.0, 0, -1), (-0.5, 0.8, -1), (-0.5, -0.8, -1)])
    below = Contacts(points=points, normals=np.tile([0.0, 0, 1], (3, 1)), friction=np.full(3, 0.5))
    np.testing.assert_array_equal(FeedForward(below, ORIGIN).squeeze(1.0).forces, 0.0)


def test_no_finger_is_asked_to_pull_where_no_friction_is_needed() -> None:
    """Three fingers along one line share a load along it in many ways; in a cone without width some would pull."""
    points = np.array([(0.03, 0.01, 0), (0.07, -0.01, 0), (-0.05, -0.03, 0)])
    contacts = Contacts(points=points, normals=np.array([(0.0, -1, 0), (0, 1, 0), (0, 1, 0)]), friction=np.full(3, 0.3))
    for load in (1.0, -1.0):
        wrench = np.array([0, load, 0, 0, 0, 0.0])
        forces = FeedForward(contacts, ORIGIN).answer(wrench, 4.0).forces
        assert (forces * contacts.normals).sum(axis=1).min() > -1e-4
        residual = np.einsum("iDd,id->D", grasp_maps(points, ORIGIN), forces) + wrench
        assert np.abs(residual).max() < 1e-6
