"""Before the measurement: a fingertip that is not where it was planned is named."""

from dataclasses import replace

import numpy as np

from planner.contacts import Contacts
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.rigid_object import ConvexPart
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.protocol import ACTIVE
from sim.validation.validation import Validation, validate_contacts
from tests.strategies.parts import box, rigid_object
from tests.strategies.planned_grasps import prism

BASE = box((0.04, 0.02, 0.004))
UPRIGHT = box((0.004, 0.02, 0.03), (-0.036, 0, 0.034))
"""Together an L: the corner between its inner faces is the line x = CORNER, z = 0.004."""
CORNER = -0.032
LARGEST_TIP, SMALLEST_TIP = 0.004 * max(ACTIVE.tip_radii), 0.004 * min(ACTIVE.tip_radii)


def held_at(top_x: float, *parts: ConvexPart) -> Validation:
    """Two fingers pinch the base of the L at `top_x`, one from above and one from below."""
    points = np.array([(top_x, 0, 0.004), (top_x, 0, -0.004)])
    contacts = Contacts(points=points, normals=np.array([(0, 0, -1.0), (0, 0, 1.0)]), friction=np.full(2, 0.5))
    weight = np.array([[1.0, 0, 0, 0, 0, 0]])
    phi = np.array([0.5 * np.sqrt(1 + 1 / 0.5**2)])
    return validate_contacts(
        LoadedGrasp(
            rigid_object=rigid_object(*parts),
            contacts=contacts,
            reference_point=np.array([top_x, 0, 0]),
            wrenches=weight,
            phi=phi,
        )
    )


def test_a_pinch_away_from_the_corner_is_confirmed() -> None:
    validation = held_at(-0.01, BASE, UPRIGHT)
    assert validation.verdict, validation.reasons
    assert (validation.static.touches == 1).all()


def test_near_the_other_wall_of_a_corner_a_smaller_fingertip_is_taken() -> None:
    validation = held_at(CORNER + 1e-4, BASE, UPRIGHT)
    assert validation.verdict, validation.reasons
    assert validation.static.tip_radius < 1e-4 < LARGEST_TIP


def test_a_fingertip_that_reaches_into_the_other_wall_of_a_corner_is_caught() -> None:
    validation = held_at(CORNER + 0.5 * SMALLEST_TIP, BASE, UPRIGHT)
    assert not validation.verdict
    assert validation.reasons[0].startswith("fingertip 1")
    assert validation.vertices is None


def test_a_fingertip_that_just_touches_the_other_wall_is_caught() -> None:
    validation = held_at(CORNER + 1.0001 * SMALLEST_TIP, BASE, UPRIGHT)
    assert not validation.verdict
    assert "fingertip 1 touches 2 parts" in validation.reasons[0]
    assert len(validation.reasons) == 1


def test_a_contact_planned_inside_the_hull_of_a_concave_mesh_is_caught() -> None:
    assert isinstance(UPRIGHT, Polyhedron)
    hull = Polyhedron.hull(np.vstack([BASE.vertices, UPRIGHT.vertices]), geom="one mesh", friction=0.5)
    validation = held_at(-0.01, hull)
    assert not validation.verdict
    assert "fingertip 1" in validation.reasons[0] and "inside" in validation.reasons[0]


def test_a_contact_off_the_surface_is_caught() -> None:
    planned = prism()
    lifted = planned.contacts.points - 1e-6 * planned.contacts.normals
    contacts = Contacts(points=lifted, normals=planned.contacts.normals, friction=planned.contacts.friction)
    validation = validate_contacts(replace(planned.loaded, contacts=contacts))
    assert len(validation.reasons) == 3
    assert all("off the collision surface" in reason for reason in validation.reasons)
