"""What is shown is what `grasp-validate` measures."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.errors import SettingError
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.task import make_task
from sim.render.drawn_motion import drawn_pose
from sim.render.recording import FAR, Recording, known_outcome, outcome, record
from sim.trial.protocol import ACTIVE
from tests.strategies.planar_grasps import planned

BALL = '<mujoco><worldbody><body name="b"><freejoint/><geom size=".03"/></body></worldbody></mujoco>'


def test_the_film_is_the_trial_of_the_validation_step_by_step(recording: Recording) -> None:
    """The held simulation to the last bit; the lost one, which a validation leaves early, by its verdict."""
    experiment, trial = recording.experiment, recording.trial
    validated = experiment.perform(trial)
    shown = recording.measurement
    assert validated.held.tolist() == shown.held.tolist() == [True, False]
    for name in ("slips", "separations", "translations", "rotations", "measured_forces"):
        np.testing.assert_array_equal(getattr(validated, name)[0], getattr(shown, name)[0])
    assert recording.steps == 550
    assert recording.times[-1] == pytest.approx(ACTIVE.duration)


def test_the_slip_that_is_drawn_ends_at_the_slip_that_is_judged(recording: Recording) -> None:
    for simulation in (0, 1):
        assert recording.measured(simulation).slip[-1] == recording.measurement.slip[simulation]
    lost = recording.measured(1)
    crossed = int((lost.slip >= ACTIVE.slip_tolerance).argmax())
    assert crossed > round((ACTIVE.preload_time + 0.9 * ACTIVE.ramp_time) / ACTIVE.timestep)


def ball(folder: Path) -> tuple[RigidObject, Grasp]:
    file = folder / "ball.xml"
    file.write_text(BALL)
    seen = read_object(file)
    candidates = make_candidates(seen, "40", 0.5, seed=0)
    return seen, plan(
        GraspProblem(seen, make_task("gravity", seen), candidates, fingers=3), search=CertifiedSearch(gap=0.2)
    )


def spanner(_: Path) -> tuple[RigidObject, Grasp]:
    return planned("concave", 3)


@pytest.mark.parametrize("grasp", [ball, spanner])
def test_the_drawn_forces_are_those_that_were_commanded_while_the_grasp_holds(
    grasp: Callable[[Path], tuple[RigidObject, Grasp]], tmp_path: Path
) -> None:
    """A ball is MuJoCo's first geom of a contact, a mesh its second: their contact frames differ."""
    recording = record(*grasp(tmp_path))
    assert recording.measurement.held[0]
    trial, loads = recording.trial, recording.loads
    for step in (120, 549):
        expected = trial.preloads[0] + loads[step] * (trial.forces[0] - trial.preloads[0])
        np.testing.assert_allclose(recording.forces(step, 0), expected, atol=2e-3)
        norms = np.linalg.norm(recording.readings[step, 0, :, 1:], axis=1)
        np.testing.assert_allclose(np.linalg.norm(recording.forces(step, 0), axis=1), norms, atol=1e-12)


def test_a_lost_object_is_left_where_it_has_gone_far(prism: RigidObject, golden_grasp: Grasp) -> None:
    """With 0.6 of the force that is needed the prism flies away in both simulations, the second one first."""
    hopeless = replace(golden_grasp, phi=0.6 * golden_grasp.phi)
    recording = record(prism, hopeless)
    assert not recording.as_predicted
    lost = recording.measured(1)
    motion = np.maximum(lost.translations, lost.rotations)
    assert FAR <= motion[-1] < 2 * FAR
    np.testing.assert_array_equal(recording.coordinates[-1, 1], recording.coordinates[-5, 1])
    assert len(recording.loads) == recording.steps < 550, "a recording goes on after both are lost"


def test_another_wrench_is_shown_around_what_it_needs_itself(
    prism: RigidObject, golden_grasp: Grasp, recording: Recording
) -> None:
    other = int(np.abs(golden_grasp.phi - 0.7 * golden_grasp.rho).argmin())
    shown = record(prism, golden_grasp, other)
    np.testing.assert_allclose(shown.measurement.caps, golden_grasp.phi[other] * np.array([1.02, 0.98]))
    assert shown.measurement.held.tolist() == [True, False]
    assert shown.as_predicted
    assert not replace(recording, need=1.05 * recording.need).as_predicted
    assert "held; slip" in shown.summary()[0] and "slipped; slip" in shown.summary()[1]
    assert outcome(False, 0.0, ACTIVE) == "lost"


def test_a_spin_counts_as_the_slip_that_is_as_much_of_what_a_hold_allows(recording: Recording) -> None:
    rows = recording.measurement
    np.testing.assert_array_equal(rows.gone(ACTIVE), rows.slip)  # hard fingers spin as they like
    for part in (0.99, 1.01):
        spins = np.full_like(rows.slips, part * ACTIVE.spin_tolerance)
        spinning = replace(rows, slips=0 * rows.slips, spins=spins, held=np.full(2, part < 1))
        assert spinning.gone(ACTIVE) == pytest.approx(part * ACTIVE.slip_tolerance)
        assert known_outcome(spinning, 0, ACTIVE) == ("" if part < 1 else "slipped")


def test_a_soft_grasp_is_held_and_lost_by_its_torques_too(soft_recording: Recording) -> None:
    """The torques that MuJoCo reads are those of balance, about the inward normals."""
    assert soft_recording.as_predicted
    held, lost = (soft_recording.measured(simulation) for simulation in (0, 1))
    last = soft_recording.steps - 1
    drawn = drawn_pose(soft_recording, last, 0, 1.0).torques
    expected = soft_recording.trial.torques[0]
    assert np.abs(expected).min() > 1e-3  # of the newton metre of the experiment: a sign that is lost would be seen
    np.testing.assert_allclose(drawn, expected, atol=0.1 * np.abs(expected).max())
    assert not drawn_pose(soft_recording, 0, 0, 1.0).torques.any()
    protocol = soft_recording.experiment.protocol
    assert held.spin.max() < protocol.spin_tolerance < lost.spin[-1]
    assert "spin" in soft_recording.summary()[1]
    assert known_outcome(held, last, protocol) == "held"
    assert not any(known_outcome(held, step, protocol) for step in range(last))


def test_hard_fingers_twist_nothing(recording: Recording) -> None:
    assert not drawn_pose(recording, 549, 0, 1.0).torques.any()
    assert not any("spin" in line for line in recording.summary())


def test_a_wrench_that_cannot_be_shown_is_refused(prism: RigidObject, golden_grasp: Grasp) -> None:
    for wrench in (-1, 64):
        with pytest.raises(SettingError, match=f"wrench {wrench} is not one .* 0 to 63"):
            record(prism, golden_grasp, wrench)
    idle = replace(golden_grasp, phi=np.append(golden_grasp.phi, 0.0))
    with pytest.raises(SettingError, match="wrench 64 needs no fingertip force"):
        record(prism, idle, 64)
