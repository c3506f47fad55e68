"""How a user says that fingers resist turning."""

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.errors import CandidateError
from tests.strategies.parts import box, rigid_object
from tests.strategies.planar_objects import planar_object

BRICK = rigid_object(box((0.05, 0.03, 0.08)))


def test_a_patch_has_two_thirds_of_friction_times_its_radius() -> None:
    pads = make_candidates(BRICK, "30", 0.6).twisting(patch=0.004)
    assert pads.contacts.torsions == pytest.approx(np.full(30, 2 / 3 * 0.6 * 0.004))
    assert pads.choice is not None
    assert (pads.choice.torsion, pads.choice.patch) == (None, 0.004)


def test_torsion_is_a_length_and_zero_is_a_hard_finger() -> None:
    soft = make_candidates(BRICK, "30").twisting(0.002, None)
    assert soft.contacts.torsions == pytest.approx(np.full(30, 0.002))
    assert soft.twisting(0.0, None).contacts.torsion is None
    assert soft.twisting(None, None) is soft


def test_an_uncertain_friction_leaves_the_least_of_both() -> None:
    least = make_candidates(BRICK, "30", 0.5).twisting(0.002, None).least_friction(0.2)
    assert least.contacts.friction == pytest.approx(np.full(30, 0.4))
    assert least.contacts.torsions == pytest.approx(np.full(30, 0.0016))
    other_way_round = make_candidates(BRICK, "30", 0.5).least_friction(0.2).twisting(0.002, None)
    assert other_way_round.contacts.torsions == pytest.approx(np.full(30, 0.0016))
    assert other_way_round.choice == least.choice


@pytest.mark.parametrize(
    ("torsion", "patch", "said"),
    [(0.002, 0.004, "give one of them"), (-0.002, None, "torsion -0.002 m: .*0 or more"), (None, np.nan, "patch nan")],
)
def test_what_makes_no_sense_is_refused(torsion: float | None, patch: float | None, said: str) -> None:
    with pytest.raises(CandidateError, match=said):
        make_candidates(BRICK, "30").twisting(torsion, patch)


def test_planar_objects_have_no_fingers_that_twist() -> None:
    with pytest.raises(CandidateError, match="for objects in space"):
        make_candidates(planar_object([(0, 0), (0.1, 0), (0.1, 0.1), (0, 0.1)]), "12").twisting(0.002, None)
