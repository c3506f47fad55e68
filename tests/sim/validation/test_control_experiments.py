"""The controls: what must fail fails, what must not creep does not, and a broken instrument is not believed."""

from dataclasses import replace

import numpy as np
import pytest

import sim.validation.control_experiments
from planner.arrays import Floats
from planner.contacts import Contacts
from sim.trial.prediction import predicted_caps
from sim.trial.protocol import ACTIVE
from sim.validation.control_experiments import displacement_control
from sim.validation.displacement import displaced_grasps
from sim.validation.verdict import Verdict, judge
from tests.strategies.parts import box, rigid_object
from tests.strategies.planned_grasps import Planned, prism

GRASP = replace(prism(), wrenches=prism().wrenches[::4])


def test_all_controls_of_a_true_grasp_behave() -> None:
    controls = {control.name: control for control in GRASP.validated().controls}
    assert all(control.behaved for control in controls.values())
    assert not controls["cap"].outcomes[0].held
    assert controls["creep"].outcomes[0].slip < ACTIVE.creep_tolerance
    friction = [outcome for outcome in controls["friction"].outcomes if outcome.counted]
    assert all(outcome.held == (outcome.phi is not None and outcome.phi < outcome.cap) for outcome in friction)
    assert 0 < sum(outcome.held for outcome in friction) < len(friction)
    assert [outcome.held for outcome in controls["displaced contact"].outcomes] == [True, False]


def test_a_prediction_that_ignores_friction_makes_the_verdict_not_trustworthy(monkeypatch: pytest.MonkeyPatch) -> None:
    def blind(contacts: Contacts, reference_point: Floats, wrenches: Floats) -> Floats:
        return predicted_caps(replace(contacts, friction=np.full(3, 0.3)), reference_point, wrenches)

    monkeypatch.setattr(sim.validation.control_experiments, "predicted_caps", blind)
    validation = GRASP.validated()
    assert validation.verdict is Verdict.NOT_TRUSTWORTHY and not validation.verdict
    assert len(validation.reasons) == 1 and "control 'friction' did not behave" in validation.reasons[0]


def test_a_creeping_instrument_is_not_trusted() -> None:
    validation = GRASP.validated(protocol=replace(ACTIVE, solimp=(0.9, 0.95, 1e-3, 0.5, 2.0), impratio=1.0))
    assert validation.verdict is Verdict.NOT_TRUSTWORTHY


def test_doubts_outweigh_objections() -> None:
    assert judge((), ()) is Verdict.PASS and bool(Verdict.PASS)
    assert judge(("slipped",), ()) is Verdict.FAIL and not Verdict.FAIL
    assert judge(("slipped",), ("creeps",)) is Verdict.NOT_TRUSTWORTHY


def test_displaced_contacts_stay_on_their_face_at_the_wanted_distance() -> None:
    grasp = prism()
    solid = rigid_object(*grasp.parts)
    distance = 0.02 * solid.size
    displaced = list(displaced_grasps(solid, grasp.contacts, distance))
    assert len(displaced) == 12  # three fingers, four tangents, no edge is near
    for each in displaced:
        moved = np.linalg.norm(each.contacts.points - grasp.contacts.points, axis=1)
        np.testing.assert_allclose(moved, distance * np.eye(3)[each.finger], atol=1e-12)
        np.testing.assert_allclose(solid.parts[0].depth(each.contacts.points), 0, atol=1e-12)
        np.testing.assert_allclose(each.contacts.normals, grasp.contacts.normals, atol=1e-15)


def test_a_contact_in_the_middle_of_a_face_too_small_to_move_on_stays() -> None:
    thin = box((0.05, 0.0001, 0.0001))
    points = np.array([(-0.05, 0, 0), (0.05, 0, 0)])
    contacts = Contacts(points=points, normals=np.sign(-points), friction=np.full(2, 0.5))
    pull = np.array([[0, 0, -1.0, 0, 0, 0]])
    planned = Planned(parts=(thin,), contacts=contacts, reference_point=np.zeros(3), wrenches=pull)
    control = displacement_control(planned.loaded, ACTIVE)
    assert control.behaved and not control.outcomes
    assert control.outcome() == "not possible on this grasp"
