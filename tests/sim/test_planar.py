"""Planar grasps in MuJoCo: slabs that move in their plane only, measured like any other grasp."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from planner.contacts import Contacts
from planner.grasps.lift import lift_contacts
from planner.objects.object_file import read_object_file
from planner.objects.planar.extrusion import extruded
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.rigid_object import RigidObject
from sim.scene.object_joints import FreeJoint, PlanarJoints, joints_of
from sim.trial.experiment import set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.protocol import STRICT
from sim.validation.displacement import displaced_grasps
from sim.validation.validation import Validation, validate_contacts
from sim.validation.verdict import Verdict
from tests.strategies.planar_grasps import CASES, planned
from tests.strategies.planar_objects import HOOK, planar_object
from tests.tools.commands import ASSETS
from tests.tools.lanes import first_fast


def validated(name: str, fingers: int, *, rho_error: float = 1.0, friction_error: float = 1.0) -> Validation:
    """Validation to half a percent with rho and the simulated friction multiplied by their errors."""
    slab, grasp = planned(name, fingers)
    loaded = LoadedGrasp.of(slab, replace(grasp, phi=rho_error * grasp.phi))
    return validate_contacts(loaded, STRICT, simulated_friction=friction_error * grasp.contacts.friction)


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("name", first_fast(CASES))
def test_the_optimal_grasps_of_our_planar_cases_are_confirmed_within_half_a_percent(name: str, fingers: int) -> None:
    validation = validated(name, fingers)
    assert validation.verdict is Verdict.PASS, validation.reasons
    assert validation.vertices is not None
    assert validation.vertices.held.tolist() == 16 * [True]


def test_a_rho_three_percent_low_is_refuted_by_a_wrench_that_slips() -> None:
    validation = validated("concave", 3, rho_error=0.97)
    assert validation.verdict is not Verdict.PASS
    assert "not held" in validation.reasons[0]


@pytest.mark.slow
def test_a_rho_three_percent_high_is_noticed_by_the_control_that_holds() -> None:
    validation = validated("convex", 2, rho_error=1.03)
    assert validation.verdict is Verdict.NOT_TRUSTWORTHY


@pytest.mark.parametrize("friction_error", first_fast([0.95, 1.05]))
def test_friction_five_percent_off_the_planned_is_noticed(friction_error: float) -> None:
    assert validated("convex", 3, friction_error=friction_error).verdict is not Verdict.PASS


def test_a_contact_moved_for_a_control_stays_in_the_plane() -> None:
    slab, grasp = planned("concave", 3)
    moved = list(displaced_grasps(slab, grasp.contacts, 0.002))
    assert len(moved) > 2
    for other in moved:
        np.testing.assert_allclose(other.contacts.points[:, 2], 0, atol=1e-12)


def concave_corner(distance: float) -> tuple[str, ...]:
    """What the static check says of two fingers on the spanner's head, one of them this far from its handle."""
    planar = read_object_file(ASSETS / "planar" / "concave.toml")
    assert isinstance(planar, PlanarObject)
    points = np.array([(-0.0135, 0.01 + distance), (0.0515, 0.02)])
    facets = planar.outline.nearest_facet(points)
    _, normals = planar.outline.project(points, facets)
    contacts = lift_contacts(Contacts(points=points, normals=normals, friction=np.full(2, 0.3)))
    grasp = LoadedGrasp(
        rigid_object=extruded(planar),
        contacts=contacts,
        reference_point=np.array([0.0, 0.02, 0.0]),
        wrenches=np.eye(1, 6),
        phi=np.ones(1),
    )
    experiment = set_up(grasp, STRICT)
    return experiment.static.reasons()


def test_a_fingertip_in_a_concave_corner_narrower_than_itself_is_caught() -> None:
    assert concave_corner(0.002) == ()
    (reason,) = concave_corner(1e-4)
    assert reason.startswith("fingertip 1") and "a wall is too near" in reason


def test_the_slab_slides_and_turns_as_mujoco_says() -> None:
    """The pose read from the joints' coordinates, against MuJoCo's own kinematics."""
    slab, grasp = planned("convex", 2)
    scene = set_up(replace(LoadedGrasp.of(slab, grasp), reference_point=np.zeros(3)), STRICT).scene
    assert isinstance(scene.joints, PlanarJoints)
    assert scene.model.nq == scene.joints.positions + 3 * 2
    assert scene.model.nv == scene.joints.velocities + 3 * 2
    data = mujoco.MjData(scene.model)
    data.qpos[:3] = 0.01, -0.02, 2.5
    mujoco.mj_kinematics(scene.model, data)
    position, quaternion = scene.joints.pose(data.qpos[None])
    np.testing.assert_allclose(position[0], data.xpos[scene.object_body], atol=1e-15)
    np.testing.assert_allclose(quaternion[0], data.xquat[scene.object_body], atol=1e-15)


def test_only_slabs_are_kept_in_a_plane(prism: RigidObject) -> None:
    assert isinstance(joints_of(prism), FreeJoint)
    assert isinstance(joints_of(extruded(planar_object(HOOK))), PlanarJoints)
