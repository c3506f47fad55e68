"""Grasps whose least cap a pencil can find, measured; and what must not change the measurement."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.objects.parts.cylinder import Cylinder
from planner.objects.pose import Pose
from sim.trial.protocol import ACTIVE, ValidationProtocol
from sim.validation.critical_force import CriticalForce, measure_critical_force
from tests.strategies.parts import box
from tests.strategies.planned_grasps import Planned, prism

FRICTION = 0.5


def measured(planned: Planned, phi: Floats, protocol: ValidationProtocol = ACTIVE) -> CriticalForce:
    return measure_critical_force(replace(planned.loaded, phi=phi), protocol)


def few(planned: Planned) -> Planned:
    """Only some of the wrenches."""
    return replace(planned, wrenches=planned.wrenches[5::16])


def pinched_block(wrenches: Floats) -> Planned:
    """Two fingers on opposite sides of a block, along x."""
    points = np.array([(-0.04, 0, 0), (0.04, 0, 0)])
    contacts = Contacts(points=points, normals=np.sign(-points), friction=np.full(2, FRICTION))
    block = box((0.04, 0.02, 0.03))
    return Planned(parts=(block,), contacts=contacts, reference_point=np.zeros(3), wrenches=wrenches)


def test_a_block_between_two_fingers_tilted_by_gravity_needs_the_cap_of_the_closed_form() -> None:
    """At angle a from the sides: t = W cos a / 2 at each, n = t / mu on one side, W sin a more on the other."""
    angles = np.deg2rad([0.0, 20.0, 45.0, 70.0])
    weights = np.zeros((len(angles), 6))
    weights[:, 0], weights[:, 2] = np.sin(angles), -np.cos(angles)
    tangential = np.cos(angles) / 2
    phi = np.hypot(tangential, tangential / FRICTION + np.sin(angles))
    critical = measured(pinched_block(weights), phi)
    assert ((critical.ratios > 0.995) & (critical.ratios < 1.005)).all(), critical.ratios


def test_three_fingers_around_a_cylinder_resist_a_moment_about_its_axis_with_friction_alone() -> None:
    """M = 3 R t and n = t / mu at every finger, so the cap is t sqrt(1 + 1 / mu^2)."""
    radius, moment = 0.03, 0.2
    angles = np.deg2rad([90.0, 210.0, 330.0])
    outward = np.stack([np.cos(angles), np.sin(angles), np.zeros(3)], axis=1)
    part = Cylinder(pose=Pose.identity(), radius=radius, half_length=0.05, geom="cylinder", friction=FRICTION)
    contacts = Contacts(points=radius * outward, normals=-outward, friction=np.full(3, FRICTION))
    twist = np.array([[0, 0, 0, 0, 0, moment], [0, 0, 0, 0, 0, -moment]])
    planned = Planned(parts=(part,), contacts=contacts, reference_point=np.zeros(3), wrenches=twist)
    phi = np.full(2, moment / (3 * radius) * np.sqrt(1 + 1 / FRICTION**2))
    critical = measured(planned, phi)
    assert ((critical.ratios > 0.995) & (critical.ratios < 1.005)).all(), critical.ratios


@pytest.mark.slow
def test_a_turned_and_moved_grasp_has_the_same_measured_caps() -> None:
    still = few(prism())
    moved = few(prism(rotation=Rotation.from_rotvec([0.4, -1.1, 2.0]).as_matrix(), offset=np.array([0.3, -0.2, 0.1])))
    phi = still.phi
    np.testing.assert_allclose(measured(moved, phi).ratios, measured(still, phi).ratios, atol=0.0013)


@pytest.mark.slow
def test_a_mirrored_grasp_has_the_mirrored_measurement() -> None:
    """Mirrored at x = y, the prism is itself and every axial moment changes sign."""
    swap = np.array([(0.0, 1, 0), (1, 0, 0), (0, 0, 1)])
    here = few(prism())
    there = replace(
        here,
        contacts=replace(here.contacts, points=here.contacts.points @ swap, normals=here.contacts.normals @ swap),
        wrenches=np.hstack([here.wrenches[:, :3] @ swap, -here.wrenches[:, 3:] @ swap]),
    )
    phi = here.phi
    np.testing.assert_allclose(measured(there, phi).ratios, measured(here, phi).ratios, atol=0.0013)


@pytest.mark.slow
def test_half_the_time_step_changes_no_measured_cap_by_three_permille() -> None:
    grasp = few(prism())
    phi = grasp.phi
    fine = replace(ACTIVE, timestep=ACTIVE.timestep / 2)
    np.testing.assert_allclose(measured(grasp, phi, fine).ratios, measured(grasp, phi).ratios, atol=0.003)


@pytest.mark.parametrize("factor", [0.995, 1.005])
def test_a_weight_is_held_by_two_fingers_if_and_only_if_twice_friction_times_press_carries_it(factor: float) -> None:
    """The fingers may press with n = sqrt(cap^2 - (W/2)^2); they hold W if 2 mu n >= W."""
    weight = 1.0
    phi = np.array([weight / 2 * np.sqrt(1 + 1 / FRICTION**2)])
    critical = measured(pinched_block(np.array([[0, 0, -weight, 0, 0, 0.0]])), factor * phi)
    assert abs(critical.ratio * factor - 1) < 0.005
