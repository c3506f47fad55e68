"""The page's scene is the grasp: its nodes are read back from the server, without a browser."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.view.subject import Subject, subject
from tests.strategies.planar_grasps import planned

pytest.importorskip("viser", reason="the live view needs the extra viz")

from sim.render.proportions import ARROW, BEYOND, CONE_HEIGHT, FULL_TURN, LEAST_FORCE, TWIST
from sim.view.controls import PLAN, TRIAL
from sim.view.viewer import Viewer

if TYPE_CHECKING:
    from sim.view.server import Server

FOOT, TIP = slice(0, 48), slice(-48, None)
"""Vertices of an arrow."""


def ask(control: Any, value: object) -> None:
    """What a browser does."""
    control.value = value


def arrow(node: Any) -> tuple[Floats, Floats]:
    """Foot and tip of an arrow, each ring of vertices being one point."""
    assert node.visible
    return node.vertices[FOOT].mean(axis=0), node.vertices[TIP].mean(axis=0)


def test_the_slider_shows_the_forces_of_the_grasp_file(server: "Server", prism_subject: Subject) -> None:
    viewer, grasp = Viewer(server, [prism_subject]), prism_subject.grasp
    size, origin = prism_subject.rigid_object.size, grasp.task.reference_point
    viewer.refresh(0.0)
    assert viewer.controls.wrench == grasp.critical_wrench
    for wrench in (grasp.critical_wrench, 0, 17, len(grasp.phi) - 1):
        ask(viewer.controls._wrench, wrench)
        viewer.refresh(0.04)
        fingers = viewer.trials[0].fingers
        assert [finger.label.text for finger in fingers] == ["1", "2", "3"]
        for finger, point, force in zip(fingers, grasp.contacts.points, grasp.forces[wrench], strict=True):
            foot, tip = arrow(finger.force.node)
            np.testing.assert_allclose(size * tip + origin, point, atol=1e-6)
            np.testing.assert_allclose(tip - foot, ARROW * force / grasp.rho, atol=1e-6)
        foot, tip = arrow(viewer.trials[0].load.force.node)
        np.testing.assert_allclose(tip - foot, ARROW * grasp.task.wrenches[wrench, :3] / grasp.rho, atol=1e-6)
        assert f"{grasp.phi[wrench]:.4g} N" in viewer.controls.asked.content
    ask(viewer.controls._critical, True)
    viewer.refresh(0.04)
    assert viewer.controls.wrench == grasp.critical_wrench


def test_torques_are_arcs_about_the_normals_that_turn_as_they_do(
    server: "Server", soft_subject: Subject, prism_subject: Subject
) -> None:
    viewer, grasp = Viewer(server, [soft_subject, prism_subject]), soft_subject.grasp
    viewer.refresh(0.0)
    turns = set()
    for wrench in (grasp.critical_wrench, int(np.abs(grasp.torques).max(axis=1).argmin())):
        ask(viewer.controls._wrench, wrench)
        viewer.refresh(0.04)
        for number, finger in enumerate(viewer.trials[0].fingers):
            share = grasp.torques[wrench, number] / (grasp.contacts.torsions[number] * grasp.rho)
            assert finger.torque.arc.visible == finger.torque.head.node.visible == (abs(share) > LEAST_FORCE)
            if abs(share) < LEAST_FORCE:
                continue
            normal = soft_subject.contacts.normals[number]
            arms = finger.torque.arc.points - soft_subject.contacts.points[number] + BEYOND * normal
            np.testing.assert_allclose(np.linalg.norm(arms, axis=2), TWIST, rtol=1e-5)
            np.testing.assert_allclose(arms @ normal, 0, atol=1e-6)
            sines = np.cross(arms[:, 0], arms[:, 1]) @ normal / TWIST**2
            assert np.arcsin(sines).sum() == pytest.approx(FULL_TURN * share, rel=1e-3)
            turns.add(bool(share > 0))
    assert turns == {True, False}  # so a sign that is lost would be seen
    ask(viewer.controls._grasp, viewer.controls._grasp.options[1])
    viewer.refresh(0.04)
    assert not any(finger.torque.arc.visible for finger in viewer.trials[0].fingers)


def test_cones_stand_on_the_contacts_open_as_wide_as_friction_allows(server: "Server", prism_subject: Subject) -> None:
    viewer, contacts = Viewer(server, [prism_subject]), prism_subject.contacts
    viewer.refresh(0.0)
    for finger, point, normal in zip(viewer.trials[0].fingers, contacts.points, contacts.normals, strict=True):
        turned = Rotation.from_quat(finger.cone.wxyz, scalar_first=True).apply(finger.cone.vertices)
        outward, across = -turned @ normal, np.linalg.norm(np.cross(turned, normal), axis=1)
        np.testing.assert_allclose(finger.cone.position, point, atol=1e-9)
        assert (outward.min(), outward.max()) == pytest.approx((0, CONE_HEIGHT), abs=1e-6)
        rim = across > 1e-6
        np.testing.assert_allclose(across[rim], 0.3 * outward[rim], rtol=1e-5)


def test_the_trial_plays_until_one_object_is_held_and_one_is_lost(server: "Server", prism_subject: Subject) -> None:
    viewer = Viewer(server, [prism_subject], trial=True)
    viewer.refresh(0.0)
    first, second = viewer.trials
    assert first.root.visible and second.root.visible and viewer.screening is not None
    assert viewer.controls.playback.visible
    assert not first.load.force.node.visible  # the load comes later
    viewer.refresh(1.0)
    assert viewer.controls.step == 100
    ask(viewer.controls._play, True)
    viewer.refresh(1.0)
    assert viewer.controls.step == 100 and viewer.controls._play.label == "play"
    ask(viewer.controls._play, True)
    viewer.refresh(100.0)
    last = viewer.screening.playback.last
    assert viewer.controls.step == last
    assert first.caption.text.endswith("HELD") and second.caption.text.endswith("SLIPPED")
    moved = [float(np.linalg.norm(trial.object.position)) for trial in viewer.trials]
    assert moved[0] < 1e-3 < 5e-3 < moved[1]
    enlarged = np.array(second.object.position)
    ask(viewer.controls._enlarged, False)
    viewer.refresh(0.04)
    np.testing.assert_allclose(second.object.position * viewer.screening.playback.factor, enlarged)
    curves = viewer.screening.chart._node.data
    assert [len(curve) for curve in curves] == [last + 1] * 4
    assert curves[1][-1] < curves[3][-1] < curves[2][-1]  # held, limit, slipped
    ask(viewer.controls._step, 200)
    viewer.refresh(0.04)
    assert len(viewer.screening.chart._node.data[0]) == 201
    ask(viewer.controls._shown, PLAN)
    viewer.refresh(0.04)
    assert viewer.screening is None and not second.root.visible and not viewer.controls.playback.visible
    np.testing.assert_allclose(first.object.position, 0)


def test_another_grasp_takes_the_place_of_the_first(server: "Server", prism_subject: Subject) -> None:
    plate = subject("plate", *planned("convex", 2))
    viewer = Viewer(server, [prism_subject, plate], trial=True)
    viewer.refresh(0.0)
    before = viewer.trials[0]
    ask(viewer.controls._grasp, viewer.controls._grasp.options[1])
    viewer.refresh(0.04)
    assert viewer.subject is plate and viewer.screening is not None
    assert viewer.screening.playback.subject is plate
    assert [len(trial.fingers) for trial in viewer.trials] == [2, 2]
    assert viewer.controls.wrench == plate.grasp.critical_wrench
    with pytest.raises(RuntimeError, match="removed"):
        before.object.position = np.ones(3)


def test_what_no_browser_of_ours_sends_is_read_as_something_that_exists(
    server: "Server", prism_subject: Subject
) -> None:
    viewer = Viewer(server, [prism_subject])
    viewer.refresh(0.0)
    ask(viewer.controls._wrench, 10**9)
    ask(viewer.controls._grasp, "nonsense")
    viewer.refresh(0.04)
    assert (viewer.controls.wrench, viewer.controls.grasp) == (63, 0)


def test_a_wrench_that_needs_no_force_has_a_plan_and_a_reason_for_no_trial(
    server: "Server", prism: RigidObject, golden_grasp: Grasp
) -> None:
    task = replace(golden_grasp.task, wrenches=np.vstack([golden_grasp.task.wrenches, np.zeros(6)]))
    forces = np.concatenate([golden_grasp.forces, np.zeros((1, 3, 3))])
    torques, phi = np.vstack([golden_grasp.torques, np.zeros(3)]), np.append(golden_grasp.phi, 0.0)
    idle = replace(golden_grasp, task=task, phi=phi, forces=forces, torques=torques)
    viewer = Viewer(server, [subject("idle", prism, idle)])
    viewer.refresh(0.0)
    ask(viewer.controls._wrench, 64)
    ask(viewer.controls._shown, TRIAL)
    viewer.refresh(0.04)
    assert viewer.screening is None
    assert "wrench 64 needs no fingertip force" in viewer.controls.forces.content
    assert not any(finger.force.node.visible for finger in viewer.trials[0].fingers)
    ask(viewer.controls._wrench, 49)
    viewer.refresh(0.04)
    assert viewer.screening is not None
