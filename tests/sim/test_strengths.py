"""Fingers of different strength in MuJoCo: each saturates at its own share, and rho is right for that alone."""

from dataclasses import replace

import numpy as np
import pytest

from planner.errors import ContactError, SettingError
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from planner.task import Task
from sim.benches.dexgraspbench import dexgraspbench
from sim.squeeze.squeeze import measure_squeeze_force
from sim.trial.feed_forward import FeedForward
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.prediction import predicted_caps
from sim.trial.protocol import ACTIVE
from sim.validation.critical_force import measure_critical_force
from sim.validation.document import to_document
from sim.validation.validation import Validation, validate
from sim.validation.verdict import Verdict

WEAK = 2
"""The finger of strength 0.5."""


def few_wrenches(grasp: Grasp, count: int) -> Grasp:
    """The grasp with the most demanding wrenches only."""
    kept = np.argsort(-grasp.phi)[:count]
    task = Task(name="few", reference_point=grasp.task.reference_point, wrenches=grasp.task.wrenches[kept])
    return replace(grasp, task=task, phi=grasp.phi[kept], forces=grasp.forces[kept])


@pytest.fixture(scope="module")
def confirmed(prism: RigidObject, limited_grasp: Grasp) -> Validation:
    return validate(prism, few_wrenches(limited_grasp, 12))


def test_a_grasp_planned_with_a_weak_finger_is_confirmed(confirmed: Validation) -> None:
    assert confirmed.verdict is Verdict.PASS, confirmed.reasons
    assert confirmed.vertices is not None
    assert confirmed.forces is not None
    assert confirmed.forces.largest < 1e-3
    assert to_document(confirmed).strengths == (1.0, 1.0, 0.5)


def test_every_finger_pushes_at_most_its_share_and_the_weak_one_all_of_it(confirmed: Validation) -> None:
    assert confirmed.vertices is not None
    shares = confirmed.vertices.measured_forces / confirmed.vertices.caps[:, None]
    assert (shares <= np.array([1.0, 1.0, 0.5]) * (1 + 1e-3)).all()
    assert shares[0, WEAK] > 0.5 * (1 - 1e-2)  # the critical wrench
    assert (shares[:, :WEAK].max(axis=0) > 0.6).all()  # the strong ones do more than half


def test_a_plan_that_ignores_the_weakness_is_refuted(
    prism: RigidObject, golden_grasp: Grasp, limited_grasp: Grasp
) -> None:
    """The same contacts, planned for three strong fingers; in MuJoCo one of them is weak."""
    task = limited_grasp.task
    strong = replace(limited_grasp.contacts, strength=None)
    phi = predicted_caps(strong, task.reference_point, task.wrenches)
    assert phi.max() == pytest.approx(golden_grasp.rho, rel=1e-6)
    validation = validate(prism, few_wrenches(replace(limited_grasp, phi=phi), 12))
    assert validation.verdict is Verdict.FAIL
    assert any("not held" in reason for reason in validation.reasons)


def test_a_weak_finger_in_another_place_is_refuted(prism: RigidObject, limited_grasp: Grasp) -> None:
    swapped = replace(limited_grasp.contacts, strength=np.array([1.0, 0.5, 1.0]))
    needed = predicted_caps(swapped, limited_grasp.task.reference_point, limited_grasp.task.wrenches)
    assert needed.max() > 1.05 * limited_grasp.rho
    worst = np.argsort(-needed)[:8]
    task = replace(limited_grasp.task, wrenches=limited_grasp.task.wrenches[worst])
    forces, phi = limited_grasp.forces[worst], limited_grasp.phi[worst].copy()
    phi[0] = limited_grasp.rho  # what was planned
    validation = validate(prism, replace(limited_grasp, contacts=swapped, task=task, phi=phi, forces=forces))
    assert validation.verdict is Verdict.FAIL


def test_the_measured_force_level_is_the_predicted(prism: RigidObject, limited_grasp: Grasp) -> None:
    grasp = few_wrenches(limited_grasp, 3)
    critical = measure_critical_force(LoadedGrasp.of(prism, grasp))
    np.testing.assert_allclose(critical.ratios, 1.0, atol=5e-3)


def test_a_strong_grasp_in_other_units_is_the_same_grasp(prism: RigidObject, limited_grasp: Grasp) -> None:
    """Strengths are relative: three times as strong at a third of rho."""
    grasp = few_wrenches(limited_grasp, 4)
    contacts = replace(grasp.contacts, strength=3 * grasp.contacts.strengths)
    task = grasp.task
    np.testing.assert_allclose(predicted_caps(contacts, task.reference_point, task.wrenches), grasp.phi / 3, rtol=1e-6)
    outcome = validate(prism, replace(grasp, contacts=contacts, phi=grasp.phi / 3)).vertices
    assert outcome is not None
    assert outcome.held.all()


def test_feed_forward_forces_keep_to_each_fingers_cap(limited_grasp: Grasp) -> None:
    contacts, point = limited_grasp.contacts, limited_grasp.task.reference_point
    feed_forward = FeedForward(contacts, point)
    wrench, cap = limited_grasp.task.wrenches[limited_grasp.critical_wrench], 1.02 * limited_grasp.rho
    forces = feed_forward.answer(wrench, cap).forces
    assert (np.linalg.norm(forces, axis=1) <= cap * contacts.strengths * (1 + 1e-6)).all()
    np.testing.assert_allclose(forces.sum(axis=0), -wrench[:3], atol=1e-6 * cap)
    arms = contacts.points - point
    np.testing.assert_allclose(np.cross(arms, forces).sum(axis=0), -wrench[3:], atol=1e-6 * cap * 0.01)
    squeeze = feed_forward.squeeze(cap).forces
    np.testing.assert_allclose(squeeze.sum(axis=0), 0, atol=1e-6 * cap)
    assert (np.linalg.norm(squeeze, axis=1) / contacts.strengths).max() == pytest.approx(cap)


def test_modes_with_one_force_for_all_fingers_refuse(prism: RigidObject, limited_grasp: Grasp) -> None:
    contacts = limited_grasp.contacts
    with pytest.raises(ContactError, match=r"strengths \[1.0, 1.0, 0.5\].* measure this grasp with fingers that adapt"):
        measure_squeeze_force(LoadedGrasp.of(prism, limited_grasp))
    with pytest.raises(SettingError, match=r"strengths \[1.0, 1.0, 0.5\].*validate this grasp with fingers that adapt"):
        dexgraspbench(prism, contacts, limited_grasp.rho)


def test_all_strengths_one_is_as_if_none_were_given(prism: RigidObject, golden_grasp: Grasp) -> None:
    grasp = few_wrenches(golden_grasp, 2)
    ones = replace(grasp, contacts=replace(grasp.contacts, strength=np.ones(3)))
    plain, same = (validate(prism, each, ACTIVE).vertices for each in (grasp, ones))
    assert plain is not None
    assert same is not None
    np.testing.assert_array_equal(plain.slips, same.slips)
    np.testing.assert_array_equal(plain.measured_forces, same.measured_forces)
