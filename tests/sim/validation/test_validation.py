"""The measurement confirms what is true and refutes what is not."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import sim.trial.feed_forward
from planner.arrays import Floats
from planner.contact_models.hard_finger import HardFinger
from planner.contacts import Contacts
from planner.objects.parts.box import Box
from planner.objects.parts.capsule import Capsule
from planner.objects.parts.cylinder import Cylinder
from planner.objects.parts.ellipsoid import Ellipsoid
from planner.objects.parts.sphere import Sphere
from planner.objects.pose import Pose
from planner.objects.rigid_object import ConvexPart
from sim.trial.protocol import STRICT
from sim.validation.validation import Validation
from sim.validation.verdict import Verdict
from tests.strategies.planned_grasps import Planned, prism, with_friction
from tests.tools.lanes import first_fast


@cache
def confirmed() -> Validation:
    """The paper's Case III, measured once."""
    return prism().validated()


def test_the_papers_case_iii_is_confirmed_even_within_half_a_percent() -> None:
    validation = prism().validated(protocol=STRICT)
    assert validation.verdict, validation.reasons
    assert validation.grasp.rho == pytest.approx(0.66900, abs=1e-5)
    assert validation.vertices is not None
    assert validation.vertices.slip.max() < 1e-5
    assert validation.controls[0].outcomes[0].slip > 5 * STRICT.slip_tolerance


@pytest.mark.slow
def test_measured_contact_forces_are_the_predicted_newtons() -> None:
    vertices = confirmed().vertices
    assert vertices is not None
    np.testing.assert_allclose(vertices.measured_forces, vertices.predicted_forces, rtol=1e-3)
    assert (vertices.measured_forces <= 1.001 * vertices.caps[:, None]).all()


def test_a_rho_three_percent_low_is_refuted_by_a_wrench_that_slips() -> None:
    validation = prism().validated(rho_error=0.97)
    assert validation.verdict is Verdict.FAIL
    assert "not held" in validation.reasons[0]


def test_a_rho_three_percent_high_is_not_trusted_because_the_control_holds() -> None:
    validation = prism().validated(rho_error=1.03)
    assert validation.verdict is Verdict.NOT_TRUSTWORTHY
    assert "control 'cap' did not behave" in validation.reasons[0]


@pytest.mark.slow
def test_friction_five_percent_below_the_planned_is_noticed() -> None:
    assert not prism().validated(friction_error=0.95).verdict


@pytest.mark.slow
def test_friction_five_percent_above_the_planned_is_noticed() -> None:
    assert not prism().validated(friction_error=1.05).verdict


def test_a_planner_with_the_wrong_sign_of_moment_is_refuted(monkeypatch: pytest.MonkeyPatch) -> None:
    class Mirrored(HardFinger):
        def maps(self, contacts: Contacts, reference_point: Floats) -> Floats:
            maps = super().maps(contacts, reference_point)
            maps[:, 3:] *= -1
            return maps

    monkeypatch.setattr(sim.trial.feed_forward, "model_of", lambda _: Mirrored())
    assert not prism().validated().verdict


@pytest.mark.slow
def test_turning_and_moving_the_body_frame_changes_nothing() -> None:
    rotation = Rotation.from_rotvec([0.4, -1.1, 2.0]).as_matrix()
    moved = prism(rotation=rotation, offset=np.array([0.3, -0.2, 0.1])).validated()
    still = confirmed()
    assert moved.verdict and still.verdict
    assert moved.vertices is not None and still.vertices is not None
    np.testing.assert_allclose(moved.vertices.slip, still.vertices.slip, atol=3e-6)
    assert moved.controls[0].outcomes[0].slip == pytest.approx(still.controls[0].outcomes[0].slip, rel=0.1)


@pytest.mark.slow
def test_an_object_ten_times_as_large_slips_alike_and_reports_its_own_newtons() -> None:
    small, large = confirmed(), prism(scale=10.0).validated()
    assert large.grasp.rho == pytest.approx(100 * small.grasp.rho, rel=1e-6)
    assert small.vertices is not None and large.vertices is not None
    np.testing.assert_allclose(large.vertices.slip, small.vertices.slip, atol=1e-6)
    np.testing.assert_allclose(large.vertices.measured_forces, 100 * small.vertices.measured_forces, rtol=1e-3)


@pytest.mark.slow
def test_every_contact_may_have_its_own_friction() -> None:
    validation = with_friction(prism(), (0.25, 0.6, 0.4)).validated()
    assert validation.verdict, validation.reasons


POSE = Pose(position=np.array([0.1, -0.05, 0.02]), quaternion=np.array([0.8, 0.2, -0.4, 0.4]))
SHAPES: dict[str, ConvexPart] = {
    "box": Box.placed(POSE, np.array([0.03, 0.02, 0.04]), geom="part", friction=0.5),
    "capsule": Capsule(pose=POSE, radius=0.02, half_length=0.03, geom="part", friction=0.5),
    "cylinder": Cylinder(pose=POSE, radius=0.03, half_length=0.05, geom="part", friction=0.5),
    "ellipsoid": Ellipsoid(pose=POSE, semi_axes=np.array([0.03, 0.02, 0.05]), geom="part", friction=0.5),
    "sphere": Sphere(pose=POSE, radius=0.03, geom="part", friction=0.5),
}


@pytest.mark.parametrize("fingers", first_fast([4, 6]))
@pytest.mark.parametrize("shape", first_fast(SHAPES))
def test_every_kind_of_geom_is_measured_within_half_a_percent(shape: str, fingers: int) -> None:
    validation = around(SHAPES[shape], fingers).validated(protocol=STRICT)
    assert validation.verdict, validation.reasons


def around(part: ConvexPart, fingers: int) -> Planned:
    """Fingers about the middle of a part, against a dozen wrenches of every direction."""
    rng = np.random.default_rng(fingers)
    outward = np.array([(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1), (0.3, 0.2, 1), (0.1, -0.3, -1)])[:fingers]
    points = POSE.position + 0.04 * outward
    points, normals = part.project(points, part.nearest_facet(points))
    reach = np.linalg.norm(points - POSE.position, axis=1).max()
    wrenches = rng.normal(size=(12, 6)) * np.repeat([1.0, reach], 3)
    contacts = Contacts(points=points, normals=normals, friction=np.full(fingers, 0.7))
    return Planned(parts=(part,), contacts=contacts, reference_point=POSE.position, wrenches=wrenches)
