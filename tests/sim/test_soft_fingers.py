"""Soft fingers: physics that a pencil can check, then predictions, units, controls, and faults that must show."""

import json
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.errors import SimulationError
from sim.scene.fingertips import LEAST_TORSION, Fingertips
from sim.scene.object_joints import FreeJoint
from sim.scene.scene import build_scene, with_friction
from sim.scene.units import Units, units_of
from sim.studies.fault_injection import SOFT_FAULTS, measure_fault
from sim.trial.experiment import floating_object, set_up
from sim.trial.feed_forward import FeedForward
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.measurement import Measurement, measure
from sim.trial.prediction import on_friction_limit, predicted_caps
from sim.trial.protocol import ACTIVE, ACTIVE_SOFT, STRICT_SOFT, active_protocol
from sim.trial.trial import Trial
from sim.trial.trial import run as run_trial
from sim.validation.critical_force import measure_critical_force
from sim.validation.document import read_validation, write_validation
from sim.validation.validation import Validation, validate_contacts
from sim.validation.verdict import Verdict
from tests.strategies.parts import box, rigid_object
from tests.tools.commands import ASSETS, run

FRICTION, PRESS, ORIGIN = 0.5, 1.0, np.zeros(3)
HALF = (0.04, 0.03, 0.02)
GAMMAS = [(0.004, 0.004), (0.002, 0.006), (0.008, 0.0)]
"""Torsional friction of two fingers, their sum the same [m]."""


def pinch(gammas: tuple[float, ...], scale: float = 1.0) -> Contacts:
    """Two opposed fingers along x on a block."""
    points = scale * HALF[0] * np.array([(-1.0, 0, 0), (1, 0, 0)])
    torsion = scale * np.array(gammas)
    return Contacts(points=points, normals=np.sign(-points), friction=np.full(2, FRICTION), torsion=torsion)


def weights_off_centre(weights: Floats, offset: float) -> Floats:
    """Weights along -z that act beside the fingers' line, off by so much along y [m]."""
    wrenches = np.zeros((len(weights), 6))
    wrenches[:, 2], wrenches[:, 3] = -weights, -offset * weights
    return wrenches


def largest_weight(gammas: tuple[float, ...], offset: float) -> float:
    """W that two fingers pressing with PRESS hold: at each f_n^2 = (f_t / mu)^2 + (tau / gamma)^2 with f_t = W / 2.

    Each may twist with gamma_i sqrt(f_n^2 - (f_t / mu)^2), together with W offset.
    """
    return float(PRESS / np.hypot(1 / (2 * FRICTION), offset / sum(gammas)))


def pressed_block(gammas: tuple[float, ...], weights: Floats, offset: float) -> Measurement:
    """The fingers press with PRESS and lift half of each weight: told nothing of torques, one simulation per weight."""
    contacts, protocol = pinch(gammas), ACTIVE_SOFT
    units = units_of(contacts, ORIGIN, rho=1.0, reach=protocol.reach)
    tips = Fingertips(contacts=units.contacts(contacts), radius=0.04 * protocol.reach, mass=protocol.tip_mass)
    scene = build_scene(floating_object([box(HALF)], units, protocol, FreeJoint()), tips, protocol)
    loads = units.wrenches(weights_off_centre(weights, offset))
    press = np.repeat(PRESS * contacts.normals[None], len(weights), axis=0)
    trial = Trial(
        wrenches=loads,
        caps=np.full(len(weights), 10.0),
        preloads=press,
        preload_wrenches=np.zeros_like(loads),
        forces=press + 0.5 * weights[:, None, None] * np.array([0, 0, 1.0]),
        torques=np.zeros((len(weights), 2)),
    )
    return measure(scene, trial, run_trial(scene, trial, protocol), 1.0, protocol)


@pytest.mark.parametrize("offset", [0.002, 0.008, 0.03])
@pytest.mark.parametrize("gammas", GAMMAS)
def test_two_fingers_hold_a_weight_off_their_line_as_far_as_slip_and_spin_share_one_cone(
    gammas: tuple[float, float], offset: float
) -> None:
    weights = largest_weight(gammas, offset) * np.array([0.5, 0.99, 1.01, 1.5])
    outcome = pressed_block(gammas, weights, offset)
    np.testing.assert_array_equal(outcome.held, [True, True, False, False])
    assert outcome.spin[:2].max() < ACTIVE_SOFT.spin_tolerance / 2
    assert outcome.spin[2:].min() > 2 * ACTIVE_SOFT.spin_tolerance


def test_a_spinning_finger_is_at_its_limit_and_a_hard_one_beside_it_takes_no_torque() -> None:
    gammas, offset = GAMMAS[2], 0.008
    held = pressed_block(gammas, np.array([0.9 * largest_weight(gammas, offset)]), offset)
    share = np.hypot(0.9 * largest_weight(gammas, offset) / (2 * FRICTION), 0.9 * largest_weight(gammas, offset))
    np.testing.assert_allclose(held.measured_utilisations[0, 0] / FRICTION, share, rtol=1e-3)
    assert held.spins[0, 1] == 0.0, "a hard finger spins as it likes"


def off_centre_grasp(gammas: tuple[float, ...] = GAMMAS[0], scale: float = 1.0) -> LoadedGrasp:
    """The block held against its weight, tilted; phi is the pencil's: hypot(f_t, sqrt((f_t/mu)^2 + (W d/Gamma)^2))."""
    weight, offset = 2.0, 0.01 * scale
    angles = np.deg2rad([0.0, 50.0, 90.0, 200.0])
    wrenches = np.zeros((len(angles), 6))
    wrenches[:, 1], wrenches[:, 2] = weight * np.sin(angles), -weight * np.cos(angles)
    wrenches[:, 3] = -offset * weight * np.cos(angles)  # the weight acts at (0, offset, 0)
    normal = np.hypot(weight / (2 * FRICTION), wrenches[:, 3] / (scale * sum(gammas)))
    return LoadedGrasp(
        rigid_object=rigid_object(box((scale * HALF[0], scale * HALF[1], scale * HALF[2]))),
        contacts=pinch(gammas, scale),
        reference_point=ORIGIN,
        wrenches=wrenches,
        phi=np.hypot(weight / 2, normal),
    )


@pytest.mark.parametrize("gammas", GAMMAS)
@pytest.mark.parametrize("scale", [1.0, 0.03])
def test_the_measured_cap_of_a_weight_off_the_line_is_the_pencils(gammas: tuple[float, float], scale: float) -> None:
    ratios = measure_critical_force(off_centre_grasp(gammas, scale)).ratios
    assert ((ratios > 0.998) & (ratios < 1.002)).all(), ratios


@pytest.mark.parametrize("gammas", GAMMAS)
def test_the_predicted_cap_is_the_pencils(gammas: tuple[float, float]) -> None:
    grasp = off_centre_grasp(gammas)
    np.testing.assert_allclose(predicted_caps(grasp.contacts, ORIGIN, grasp.wrenches), grasp.phi, rtol=1e-6)


def test_the_answer_to_a_weight_off_the_line_balances_with_its_torques_and_knows_no_friction() -> None:
    grasp = off_centre_grasp()
    cap, wrench = 1.3 * grasp.rho, grasp.wrenches[0]
    push = FeedForward(grasp.contacts, ORIGIN).answer(wrench, cap)
    np.testing.assert_allclose(push.forces.sum(axis=0), -wrench[:3], atol=1e-6)
    moments = np.cross(grasp.contacts.points, push.forces) + push.torques[:, None] * grasp.contacts.normals
    np.testing.assert_allclose(moments.sum(axis=0), -wrench[3:], atol=1e-8)
    slippery = grasp.contacts.with_friction(0.3 * grasp.contacts.friction)
    np.testing.assert_allclose(FeedForward(slippery, ORIGIN).answer(wrench, cap).forces, push.forces, atol=1e-4 * cap)


def test_friction_of_another_pair_of_materials_takes_the_torsion_along() -> None:
    contacts = pinch((0.002, 0.0)).with_friction(np.array([0.25, 0.5]))
    np.testing.assert_allclose(contacts.torsions, [0.001, 0.0])
    grasp = off_centre_grasp()
    assert not on_friction_limit(grasp.contacts, ORIGIN, grasp.wrenches, 0.98).any()


def test_torsion_is_a_length_in_the_scene_and_a_hard_finger_keeps_its_condim() -> None:
    experiment = set_up(off_centre_grasp((0.008, 0.0)))
    model, length = experiment.scene.model, experiment.units.length
    assert length == pytest.approx(ACTIVE_SOFT.reach / HALF[0])
    np.testing.assert_array_equal(model.pair_dim, [4, 3])
    np.testing.assert_allclose(model.pair_friction[:, :3], [(0.5, 0.5, 0.008 * length), (0.5, 0.5, 0)])
    none = with_friction(experiment.scene, replace(experiment.scene.contacts, torsion=None))
    np.testing.assert_array_equal(none.model.pair_dim, [3, 3])
    np.testing.assert_array_equal(model.pair_dim, [4, 3])


def test_condim_four_without_torsion_would_not_be_condim_three() -> None:
    """MuJoCo raises every friction to its least: a hard finger among soft ones would twist a little."""
    scene = set_up(off_centre_grasp((0.008, 0.0))).scene
    scene.model.pair_dim[1] = 4
    data = mujoco.MjData(scene.model)
    data.qpos[scene.joints.positions] += 1e-6
    data.qpos[scene.joints.positions + 3] -= 1e-6
    mujoco.mj_forward(scene.model, data)
    assert min(contact.friction[2] for contact in data.contact) == LEAST_TORSION > 0


def test_a_torsion_too_small_for_mujoco_is_refused() -> None:
    small = 0.9 * LEAST_TORSION * HALF[0] / ACTIVE_SOFT.reach
    with pytest.raises(SimulationError, match="finger 2 is too small for MuJoCo"):
        set_up(off_centre_grasp((0.008, small)))


def test_soft_fingers_have_a_protocol_of_their_own_and_hard_ones_keep_theirs() -> None:
    assert active_protocol(pinch((0.0, 0.0))) is ACTIVE
    assert active_protocol(pinch((0.0, 0.01))) is ACTIVE_SOFT and ACTIVE_SOFT.name == "rhograsp.active-soft/1"
    assert active_protocol(pinch((0.0, 0.01)), strict=True) is STRICT_SOFT
    assert set_up(off_centre_grasp()).protocol is ACTIVE_SOFT


@cache
def validated(strict: bool = False) -> Validation:
    grasp = off_centre_grasp()
    return validate_contacts(grasp, active_protocol(grasp.contacts, strict=strict))


@pytest.mark.parametrize("strict", [False, True])
def test_a_true_soft_grasp_passes_and_loses_what_theory_says_with_less_torsion(strict: bool) -> None:
    validation = validated(strict)
    assert validation.verdict is Verdict.PASS, validation.reasons
    controls = [control for control in validation.controls if control.name == "torsion"]
    assert [control.change.split(" of ")[0] for control in controls] == [
        "torsional friction at 0.9",
        "torsional friction at 0.8",
        "torsional friction at 0",
    ]
    for control in controls:
        counted = [outcome for outcome in control.outcomes if outcome.counted]
        assert control.behaved
        assert all(outcome.held == outcome.expected for outcome in counted)
        assert not all(outcome.held for outcome in control.outcomes)
        if not control.change.startswith("torsional friction at 0 "):
            assert all(outcome.spin > 0 for outcome in counted if not outcome.expected)
    none = controls[-1].outcomes
    assert [outcome.phi is None for outcome in none] == [True, True, False, True]
    assert none[2].held, "only a force through the line needs no torque"


def test_rho_said_three_percent_too_low_is_refuted_by_a_spin() -> None:
    grasp = off_centre_grasp()
    validation = validate_contacts(replace(grasp, phi=0.97 * grasp.phi))
    assert not validation.verdict and any("spun" in reason for reason in validation.reasons)


def dropped(self: Units, contacts: Contacts) -> Contacts:
    return replace(contacts, points=self.points(contacts.points), torsion=None)


def unscaled(self: Units, contacts: Contacts) -> Contacts:
    return replace(contacts, points=self.points(contacts.points))


@pytest.mark.parametrize("mistake", [dropped, unscaled])
def test_a_scene_that_drops_the_torsion_or_takes_it_for_a_number_is_not_believed(
    mistake: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Units, "contacts", mistake)
    assert not validate_contacts(off_centre_grasp()).verdict


EXPECTED = {
    "none": (0.998, 1.002),
    "torsion beside the friction cone, not in it": (1.1, 1.6),
    "torsion 5 % lower in truth": (1.01, 1.06),
    "friction 5 % lower in truth, torsion with it": (1.03, 1.06),
}


@pytest.mark.parametrize("name", EXPECTED)
def test_a_planner_that_is_wrong_about_torsion_is_noticed(name: str) -> None:
    critical = measure_fault(off_centre_grasp(), next(fault for fault in SOFT_FAULTS if fault.name == name))
    assert critical is not None
    low, high = EXPECTED[name]
    assert low <= critical.ratio <= high


def test_a_planner_that_drops_torsion_finds_no_grasp_where_there_is_one() -> None:
    fault = next(fault for fault in SOFT_FAULTS if fault.name == "torsion dropped")
    assert measure_fault(off_centre_grasp(), fault) is None


def test_a_validation_file_carries_torsion_and_spins_and_files_without_them_still_read(tmp_path: Path) -> None:
    path, old = tmp_path / "soft.validation.json", tmp_path / "old.validation.json"
    write_validation(path, validated())
    document = read_validation(path)
    assert document.planned_torsion == document.simulated_torsion == GAMMAS[0]
    vertices = validated().vertices
    assert vertices is not None
    assert [record.spin for record in document.vertices] == vertices.spin.tolist()
    assert document.vertices[0].spin == max(finger.spin for finger in document.vertices[0].fingers) > 0
    torsion = [control for control in document.controls if control.name == "torsion"]
    assert len(torsion) == 3 and max(outcome.spin for outcome in torsion[0].outcomes) > 6e-5

    new = {"spin", "planned_torsion", "simulated_torsion", "spin_tolerance", "torsion_factors", "least_torsion"}
    old.write_text(json.dumps(without(json.loads(path.read_text()), new)))
    read = read_validation(old)
    assert read.planned_torsion == () and read.vertices[0].spin == 0.0 and read.rho == document.rho


def without(value: Any, keys: set[str]) -> Any:
    """A JSON value with some keys left out wherever they are."""
    if isinstance(value, dict):
        return {key: without(each, keys) for key, each in value.items() if key not in keys}
    return [without(each, keys) for each in value] if isinstance(value, list) else value


def test_two_pads_on_the_box_are_planned_and_pass_and_are_no_squeeze(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    grasp = tmp_path / "box.grasp.json"
    asset = ASSETS / "box" / "box.xml"
    few = ("--fingers", 2, "--patch", 0.004, "--candidates", 40, "--task", "axes6")
    assert run("grasp-plan", asset, *few, "--out", grasp) == 0
    assert run("grasp-validate", grasp, "--strict", "--out", tmp_path / "box.validation.json") == 0
    said = capsys.readouterr().out
    assert "PASS (rhograsp.active-soft-strict/1)" in said
    assert "spin        at most" in said and "control     torsional friction at 0.9 of the planned" in said
    assert run("grasp-validate", grasp, "--mode", "squeeze", "--out", tmp_path / "box.squeeze.json") == 1
    refusal = capsys.readouterr().err.splitlines()[-1]
    assert refusal.startswith("error: the fingers have torsional friction") and "fingers that adapt" in refusal
