"""What is shown of the plan is what the grasp file says."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.contacts import Contacts
from planner.errors import GraspFileError
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import read_grasp
from planner.objects.rigid_object import RigidObject
from planner.search.result import Status
from sim.view.subject import Subject, read_subject, subject
from tests.strategies.planar_grasps import planned


def test_contacts_and_forces_are_those_of_the_grasp_file(golden_file: Path) -> None:
    shown, file = read_subject(golden_file), read_grasp(golden_file)
    assert shown.name == "golden"
    size, origin = shown.rigid_object.size, file.task.reference_point
    for wrench in range(len(file.phi)):
        pose = shown.planned(wrench)
        np.testing.assert_allclose(size * pose.contacts + origin, file.contacts.points, atol=1e-15)
        np.testing.assert_allclose(file.rho * pose.forces, file.forces[wrench], atol=1e-12)


@pytest.mark.parametrize("name", ["prism_subject", "soft_subject"])
def test_the_forces_and_torques_balance_the_load_that_is_drawn(name: str, request: pytest.FixtureRequest) -> None:
    """Against the wrench in the view's own units, with nothing of the grasp map."""
    shown: Subject = request.getfixturevalue(name)
    grasp, size = shown.grasp, shown.rigid_object.size
    for wrench, (force, moment) in enumerate(grasp.task.wrenches.reshape(-1, 2, 3)):
        pose = shown.planned(wrench)
        np.testing.assert_allclose(pose.forces.sum(axis=0), -force / grasp.rho, atol=1e-6)
        turned = np.cross(pose.contacts, pose.forces).sum(axis=0) + pose.torques @ pose.normals
        np.testing.assert_allclose(turned, -moment / (grasp.rho * size), atol=1e-6)
        load = shown.load(wrench)
        np.testing.assert_allclose(np.cross(load.force, force), 0, atol=1e-12)
        assert load.force @ force > 0
        np.testing.assert_allclose(load.moment, moment / (grasp.rho * size))


def test_fingertips_touch_the_object_from_outside(prism_subject: Subject) -> None:
    pose = prism_subject.planned(0)
    prism = prism_subject.rigid_object
    centers = prism.size * pose.tips + prism_subject.grasp.task.reference_point
    gaps = np.linalg.norm(pose.contacts - pose.tips, axis=1) * prism.size
    np.testing.assert_allclose(-prism.parts[0].depth(centers), gaps, rtol=1e-9)


def test_a_planar_grasp_is_shown_on_a_slab() -> None:
    slab, grasp = planned("convex", 3)
    shown = subject("plate", slab, grasp)
    assert shown.triangles.shape[1:] == (3, 3)
    assert np.ptp(shown.triangles[..., 2]) > 0
    assert (shown.planned(0).forces[:, 2] == 0).all()


def test_a_search_without_a_grasp_is_refused(prism: RigidObject, golden_grasp: Grasp) -> None:
    nothing = Contacts(points=np.zeros((0, 3)), normals=np.zeros((0, 3)), friction=np.zeros(0))
    empty = replace(golden_grasp, contacts=nothing, phi=np.zeros(0), status=Status.INFEASIBLE)
    with pytest.raises(GraspFileError, match=r"prism holds no grasp \(status infeasible\)"):
        subject("prism", prism, empty)
