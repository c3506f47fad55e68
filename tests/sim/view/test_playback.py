"""What is played back is the trial, in the units of the view, at the pace and place that were asked for."""

import numpy as np
import pytest

from planner.arrays import Floats
from sim.render.drawn_motion import AVERAGED
from sim.trial.schedule import fractions
from sim.view.captions import about, asked, caption, measured_forces, plain, planned_forces
from sim.view.layout import ASPECT, Layout, plan_layout, trial_layout
from sim.view.playback import Playback, play_back
from sim.view.player import SLOWER, Player
from sim.view.subject import Subject


def test_the_trial_begins_where_the_grasp_was_planned(prism_subject: Subject, playback: Playback) -> None:
    planned = prism_subject.planned(prism_subject.grasp.critical_wrench)
    for simulation in (0, 1):
        pose = playback.pose(0, simulation)
        np.testing.assert_allclose(pose.contacts, planned.contacts, atol=1e-5)
        np.testing.assert_allclose(pose.position, 0, atol=1e-12)


def test_the_object_is_where_mujoco_had_it(playback: Playback) -> None:
    """In the body frame's metres: R0 is the reach of the experiment."""
    grasp, experiment = playback.subject.grasp, playback.recording.experiment
    radius = np.linalg.norm(grasp.contacts.points - grasp.task.reference_point, axis=1).max()
    moved = playback.recording.coordinates[playback.last, 1, :3] / experiment.protocol.reach * radius
    shown = playback.pose(playback.last, 1).position * playback.subject.rigid_object.size
    np.testing.assert_allclose(shown, moved, rtol=1e-9)
    assert np.linalg.norm(shown) > 1e-3 * radius
    np.testing.assert_allclose(playback.pose(playback.last, 1, 3.0).position, 3 * playback.pose(549, 1).position)


def test_measured_forces_hold_what_acts(playback: Playback) -> None:
    recording, load = playback.recording, playback.subject.grasp.task.wrenches[playback.recording.wrench, :3]
    pace = fractions(recording.experiment.protocol)
    for step in (58, 150, 549):
        shown = [recording.trial.at(*pace[each])[0][0, :3] for each in range(step + 1 - AVERAGED, step + 1)]
        acting = np.mean(shown, axis=0)  # as the forces are drawn
        np.testing.assert_allclose(playback.pose(step, 0).forces.sum(axis=0), -acting, atol=1e-2)
    np.testing.assert_allclose(acting, load / playback.subject.grasp.rho, atol=1e-12)  # at the end the whole wrench


def test_the_outcome_is_said_when_it_is_known_and_not_before(playback: Playback) -> None:
    assert caption(playback, playback.last, 0).startswith("cap 1.02 rho · slip ")
    assert caption(playback, playback.last, 0).endswith(" R0 · HELD")
    assert caption(playback, playback.last, 1).startswith("cap 0.98 rho · slip ")
    assert caption(playback, playback.last, 1).endswith(" R0 · SLIPPED")
    for simulation in (0, 1):
        assert caption(playback, 100, simulation).endswith(" R0")


def test_tables_say_force_and_share_of_friction_of_every_finger(prism_subject: Subject, playback: Playback) -> None:
    grasp = prism_subject.grasp
    for finger, force in enumerate(grasp.forces[grasp.critical_wrench]):
        normal = float(force @ grasp.contacts.normals[finger])
        share = np.sqrt(force @ force - normal**2) / (0.3 * normal)
        row = f"| {finger + 1} | {np.linalg.norm(force):.3g} N · {share:.0%} |"
        assert row in planned_forces(prism_subject, grasp.critical_wrench)
    poses = [playback.pose(playback.last, simulation) for simulation in (0, 1)]
    assert "| finger | cap 0.6824 N | cap 0.6556 N |" in measured_forces(playback, poses)
    assert "0.682 N" in measured_forces(playback, poses)  # the strongest finger is at its cap
    assert "rho: the critical wrench" in asked(prism_subject, grasp.critical_wrench)
    assert "critical" not in asked(prism_subject, 0)
    assert f"**rho = 0.669 N** (optimal, gap {100 * grasp.gap:.1g}%)" in about(grasp)


def test_soft_fingers_say_torque_and_the_share_of_the_one_cone(soft_subject: Subject, prism_subject: Subject) -> None:
    grasp, contacts = soft_subject.grasp, soft_subject.grasp.contacts
    assert "2 fingers · friction 0.5 · torsion 1.33 mm · 72 wrenches" in about(grasp)
    for wrench in (grasp.critical_wrench, 0):
        said = planned_forces(soft_subject, wrench)
        assert "| finger | planned force · torque · share of friction |" in said
        for normal, force, torque in zip(contacts.normals, grasp.forces[wrench], grasp.torques[wrench], strict=True):
            along = force @ normal
            rubbing = np.linalg.norm(force - along * normal)
            share = np.sqrt((rubbing / 0.5) ** 2 + (torque / (2 / 3 * 0.5 * 0.004)) ** 2) / along
            assert f"| {np.linalg.norm(force):.3g} N · {1000 * torque:.3g} N mm · {share:.0%} |" in said
            assert share > rubbing / (0.5 * along) + 0.01  # the torque counts
    assert "torque" not in planned_forces(prism_subject, 0) + about(prism_subject.grasp)


def test_a_trial_of_soft_fingers_measures_the_same(soft_subject: Subject) -> None:
    shown = play_back(soft_subject, soft_subject.grasp.critical_wrench)
    pose = shown.pose(shown.last, 0)
    units, contacts = soft_subject.units, soft_subject.grasp.contacts
    torques = pose.torques / (units.force * units.length)
    assert np.abs(torques).max() < 1.03 * contacts.torsions.max() * soft_subject.grasp.rho
    assert np.abs(torques).min() > 0.1 * contacts.torsions.max() * soft_subject.grasp.rho
    assert f"{1000 * torques[0]:.3g} N mm" in measured_forces(shown, [pose])
    assert "spin" in caption(shown, shown.last, 1) and "SLIPPED" in caption(shown, shown.last, 1)
    assert caption(shown, shown.last, 0).endswith("HELD")


def test_a_message_cannot_become_markup() -> None:
    text = plain("<img src=x> [a](b) `c` *d*\n| e")
    assert not set("<>[]()`*|\n=") & set(text)
    assert plain("finger 2") == "finger 2"


def inside(layout: Layout, points: Floats, width: float = 1000 * ASPECT, height: float = 1000) -> bool:
    pixels = layout.view.pixels(points, int(width), int(height))
    return bool((pixels > 0).all() and (pixels < [width, height]).all())


def test_everything_is_in_sight_and_the_simulations_stand_apart(prism_subject: Subject, playback: Playback) -> None:
    corners = prism_subject.triangles.reshape(-1, 3)
    plan = plan_layout(prism_subject, 49)
    assert inside(plan, corners) and inside(plan, prism_subject.load(49).points()) and inside(plan, plan.caption[None])
    trial = trial_layout(playback, playback.factor)
    shown = []
    for simulation, place in enumerate(trial.places):
        pose = playback.pose(playback.last, simulation, playback.factor)
        shown.append(corners @ pose.rotation.T + pose.position + place)
        assert inside(trial, shown[-1]) and inside(trial, (place + trial.caption)[None])
    left, right = (trial.view.pixels(points, 1300, 1000)[:, 0] for points in shown)
    assert left.max() < right.min()


def test_playback_is_ten_times_slower_and_stops_at_the_end() -> None:
    player = Player(timestep=1e-3, last=549)
    player.advance(1.0)
    assert player.step == round(1.0 / SLOWER / 1e-3) == 100
    player.toggle()
    player.advance(1.0)
    assert player.step == 100
    player.toggle()
    player.advance(100.0)
    assert (player.step, player.playing) == (549, False)
    player.toggle()
    assert (player.step, player.playing) == (0, True)


@pytest.mark.parametrize(("asked_for", "shown"), [(300, 300), (-5, 0), (10**9, 549)])
def test_the_visitor_puts_the_playback_where_there_is_one(asked_for: int, shown: int) -> None:
    player = Player(timestep=1e-3, last=549, at=12.3)
    player.seek(12)
    assert player.at == 12.3  # what is shown already is not a wish
    player.seek(asked_for)
    assert player.step == shown
