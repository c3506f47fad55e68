"""Physics that a pencil can check: no planner and no convex programme takes part."""

from dataclasses import replace

import numpy as np
import pytest

from planner.contacts import Contacts
from sim.scene.fingertips import Fingertips
from sim.scene.object_joints import FreeJoint
from sim.scene.scene import build_scene
from sim.scene.units import units_of
from sim.trial.experiment import floating_object
from sim.trial.measurement import Measurement, measure
from sim.trial.protocol import ACTIVE, ValidationProtocol
from sim.trial.trial import Trial, run
from tests.strategies.planned_grasps import box

FRICTION, PRESS = 0.4, 1.0
RADIUS = 0.04 * ACTIVE.reach


def squeezed_box(weights: np.ndarray, friction: np.ndarray, protocol: ValidationProtocol = ACTIVE) -> Measurement:
    """Two fingers press the sides of a box with PRESS and lift half of each weight, one simulation per weight."""
    points = np.array([(-0.05, 0, 0), (0.05, 0, 0)])
    contacts = Contacts(points=points, normals=np.sign(-points), friction=friction)
    units = units_of(contacts, np.zeros(3), rho=1.0, reach=ACTIVE.reach)
    tips = Fingertips(contacts=units.contacts(contacts), radius=RADIUS, mass=protocol.tip_mass)
    held = floating_object([box((0.05, 0.02, 0.03))], units, protocol, FreeJoint())
    scene = build_scene(held, tips, protocol)
    down = np.zeros((len(weights), 6))
    down[:, 2] = -weights
    press = np.repeat(PRESS * contacts.normals[None], len(weights), axis=0)
    lift = 0.5 * weights[:, None, None] * np.array([0, 0, 1.0])
    trial = Trial(
        wrenches=down,
        caps=np.full(len(weights), 10.0),
        preloads=press,
        preload_wrenches=np.zeros_like(down),
        forces=press + lift,
        torques=np.zeros((len(weights), 2)),
    )
    return measure(scene, trial, run(scene, trial, protocol), 1.0, protocol)


def test_two_opposed_fingers_hold_a_weight_up_to_twice_friction_times_press() -> None:
    weights = 2 * FRICTION * PRESS * np.array([0.5, 0.99, 1.01, 1.5])
    outcome = squeezed_box(weights, np.full(2, FRICTION))
    np.testing.assert_array_equal(outcome.held, [True, True, False, False])


def test_held_contact_forces_are_press_and_half_the_weight() -> None:
    weight = 0.7
    outcome = squeezed_box(np.array([weight]), np.full(2, FRICTION))
    np.testing.assert_allclose(outcome.measured_forces[0], np.hypot(PRESS, weight / 2), rtol=1e-4)


def test_the_finger_with_less_friction_is_the_one_that_slips() -> None:
    outcome = squeezed_box(np.array([1.02 * 2 * 0.2 * PRESS]), np.array([0.2, 0.8]))
    assert not outcome.held[0]
    assert outcome.slips[0, 0] > ACTIVE.slip_tolerance > outcome.slips[0, 1]


def test_a_box_that_nothing_holds_falls_as_newton_says() -> None:
    to_the_end = replace(ACTIVE, gone=np.inf, object_damping=0.0)
    outcome = squeezed_box(np.array([0.0, 30.0]), np.full(2, 1e-4), to_the_end)
    fall_time = ACTIVE.hold_time
    assert outcome.held[0] and not outcome.held[1]
    assert outcome.translations[1] * ACTIVE.reach > 0.5 * (30.0 / ACTIVE.object_mass) * fall_time**2


def test_an_object_that_is_gone_is_left_and_stays_lost() -> None:
    left, followed = (
        squeezed_box(np.array([30.0]), np.full(2, FRICTION), replace(ACTIVE, gone=gone)) for gone in (3.0, np.inf)
    )
    assert not left.held[0] and not followed.held[0]
    assert 3 * ACTIVE.motion_tolerance < left.translations[0] < 0.01 * followed.translations[0]


def test_the_largest_weight_two_fingers_hold_is_measured_within_half_a_percent() -> None:
    held, slipped = 0.8, 1.2  # weights relative to 2 mu N
    for _ in range(7):
        middle = (held + slipped) / 2
        holds = squeezed_box(np.array([middle * 2 * FRICTION * PRESS]), np.full(2, FRICTION)).held[0]
        held, slipped = (middle, slipped) if holds else (held, middle)
    assert 0.995 < held < slipped < 1.005


@pytest.mark.parametrize("count", [1, 3])
def test_simulations_of_a_batch_do_not_influence_each_other(count: int) -> None:
    alone = squeezed_box(np.array([0.7]), np.full(2, FRICTION))
    together = squeezed_box(np.array([0.7, *np.full(count, 2.0)]), np.full(2, FRICTION))
    np.testing.assert_array_equal(together.slips[0], alone.slips[0])
