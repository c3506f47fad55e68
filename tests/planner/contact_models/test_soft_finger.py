"""The soft finger's support function: between its primal and its dual, in three ways, and where theory knows it."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from planner.arrays import Floats
from planner.contact_models import friction_cone
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contact_models.soft_finger import EVEN_DISC, SOFT_FINGER, torsion_of_patch
from planner.contacts import Contacts, contact_frames
from planner.errors import ContactError
from planner.search.compiled.compile import compiled_capacities
from planner.verification.capacities import soft_capacity
from tests.strategies.force_problems import random_contacts, soft

TRIALS = 4000


def velocities(seed: int) -> tuple[Floats, Floats]:
    """v in contact frames, components over seven decades, shape (TRIALS, 4); mu, shape (TRIALS,)."""
    rng = np.random.default_rng(seed)
    v = rng.normal(size=(TRIALS, 4)) * 10.0 ** rng.uniform(-3.5, 3.5, size=(TRIALS, 4))
    return v, rng.uniform(0.05, 1.5, TRIALS)


def primal(v: Floats, friction: Floats) -> Floats:
    """max of v.x over x = (cos t, sin t, twist) on the border of the cone: by bisection on a grid, from below.

    The force is of length 1 and at the angle t to the normal; what is left of the cone turns, v_4 sqrt(...).
    """
    along, across, turning = v[:, 0], np.hypot(v[:, 1], v[:, 2]), np.abs(v[:, 3])

    def value(angle: Floats) -> Floats:
        left = (friction * np.cos(angle)) ** 2 - np.sin(angle) ** 2
        return along * np.cos(angle) + across * np.sin(angle) + turning * np.sqrt(np.maximum(left, 0))

    lower, upper = np.zeros(len(v)), np.arctan(friction)
    for _ in range(200):  # golden section: the value is concave in the angle
        one, other = upper - 0.618034 * (upper - lower), lower + 0.618034 * (upper - lower)
        better = value(one) >= value(other)
        lower, upper = np.where(better, lower, one), np.where(better, other, upper)
    best = np.max([value(lower), value(upper), value(np.arctan(friction)), value(0 * lower), 0 * lower], axis=0)
    return np.asarray(best)


def test_the_support_function_is_what_some_force_and_torque_reach() -> None:
    v, friction = velocities(0)
    h = SOFT_FINGER.support(v, friction)
    size = np.linalg.norm(v, axis=1)
    np.testing.assert_array_less(primal(v, friction), h * (1 + 1e-12) + 1e-14 * size)
    np.testing.assert_allclose(h, primal(v, friction), rtol=1e-9, atol=1e-13 * size.max())
    assert (h == 0).any()
    assert (h > 0).mean() > 0.5


def test_every_split_of_the_velocity_bounds_the_support_function() -> None:
    v, friction = velocities(1)
    along, across, turning = v[:, 0], np.hypot(v[:, 1], v[:, 2]), np.abs(v[:, 3])
    h = SOFT_FINGER.support(v, friction)
    for share in np.linspace(0, 1, 21):
        q = share * across
        bound = np.hypot(np.maximum(along + friction * np.hypot(across - q, turning), 0), q)
        assert (bound >= h * (1 - 1e-12)).all()


def test_the_search_and_the_checker_agree_with_it() -> None:
    v, friction = velocities(2)
    h = SOFT_FINGER.support(v, friction)
    values = np.empty(TRIALS)
    maps = np.ascontiguousarray(np.einsum("nk,D->nDk", v, np.eye(6)[2]))
    compiled_capacities(SOFT_FINGER)(maps, friction, np.eye(6)[2].copy(), values)
    np.testing.assert_allclose(values, h, rtol=1e-13, atol=1e-13)
    closed = soft_capacity(v[:, 0], np.hypot(v[:, 1], v[:, 2]), friction * np.abs(v[:, 3]), friction)
    np.testing.assert_allclose(closed, h, rtol=1e-12, atol=1e-12)
    assert (closed >= h * (1 - 1e-13)).all()


def test_what_does_not_turn_is_a_hard_finger() -> None:
    v, friction = velocities(3)
    v[:, 3] = 0
    hard = friction_cone.support(v[:, :3], np.eye(3)[0], friction)
    np.testing.assert_allclose(SOFT_FINGER.support(v, friction), hard, rtol=1e-12, atol=1e-15)
    contacts = random_contacts(np.random.default_rng(0), 5, 3)
    maps = SOFT_FINGER.maps(contacts, np.zeros(3))
    np.testing.assert_array_equal(maps[..., :3], HARD_FINGER.maps(contacts, np.zeros(3)))
    assert not maps[..., 3].any()


def test_a_torque_acts_about_the_normal_and_uses_its_share_of_the_cone() -> None:
    contacts = soft(random_contacts(np.random.default_rng(1), 5, 3), 0.004)
    components = np.random.default_rng(2).normal(size=(5, 4))
    forces, torques = SOFT_FINGER.forces(contacts, components), SOFT_FINGER.torques(contacts, components)
    wrenches = np.einsum("iDk,ik->iD", SOFT_FINGER.maps(contacts, np.zeros(3)), components)
    np.testing.assert_allclose(wrenches[:, :3], forces)
    moments = np.cross(contacts.points, forces) + torques[:, None] * contacts.normals
    np.testing.assert_allclose(wrenches[:, 3:], moments, atol=1e-15)
    outside = np.linalg.norm(components[:, 1:], axis=1) - contacts.friction * components[:, 0]
    np.testing.assert_allclose(
        SOFT_FINGER.excess(forces, torques, contacts), np.maximum(outside, -components[:, 0]), atol=1e-12
    )
    hard = soft(contacts, 0.0)
    assert np.isinf(SOFT_FINGER.excess(forces, torques, hard)).all()
    assert np.isfinite(SOFT_FINGER.excess(forces, 0 * torques, hard)).all()


def test_the_torsion_of_a_patch_is_friction_times_the_mean_arm_of_its_pressure() -> None:
    arm, _ = dblquad(lambda r, _: r * r, 0, 2 * np.pi, 0, 1)
    assert arm / np.pi == pytest.approx(EVEN_DISC)
    assert torsion_of_patch(0.006, np.array([0.5]))[0] == pytest.approx(0.002)


@pytest.mark.parametrize("torsion", [-1e-3, np.nan, np.inf, 1e9])
def test_torsional_friction_out_of_range_is_refused(torsion: float) -> None:
    with pytest.raises(ContactError, match="it is a length, 0 or more"):
        soft(random_contacts(np.random.default_rng(0), 3, 3), torsion)


def test_the_plane_has_no_axis_to_twist_about() -> None:
    with pytest.raises(ContactError, match="for objects in space"):
        soft(random_contacts(np.random.default_rng(0), 3, 2), 0.004)


def test_contact_frames_do_not_matter() -> None:
    contacts = soft(random_contacts(np.random.default_rng(5), 4, 3), 0.01)
    rotation = contact_frames(np.array([[0.6, 0.0, 0.8]]))[0]
    turned = Contacts(
        points=contacts.points @ rotation.T,
        normals=contacts.normals @ rotation.T,
        friction=contacts.friction,
        torsion=contacts.torsion,
    )
    direction = np.random.default_rng(6).normal(size=(2, 3))
    both = []
    for each, (force, moment) in ((contacts, direction), (turned, direction @ rotation.T)):
        maps = SOFT_FINGER.maps(each, np.zeros(3))
        v = np.einsum("iDk,D->ik", maps, np.concatenate([force, moment]))
        both.append(SOFT_FINGER.support(v, each.friction))
    np.testing.assert_allclose(both[0], both[1], rtol=1e-12)
