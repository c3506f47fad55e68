"""Fingers that are alike share their candidates; limits that leave nothing to search are refused."""

from itertools import permutations

import numpy as np
import pytest

from planner.candidates.candidates import Candidates
from planner.candidates.choice import make_candidates
from planner.errors import CandidateError, LimitsError
from planner.limits.kinds import finger_kinds
from planner.limits.limits import Finger, Limits, Zone
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from planner.search.finger_kind import FingerKind
from tests.tools.commands import ASSETS

UPRIGHT = ("upright",)


@pytest.fixture(scope="module")
def bracket() -> RigidObject:
    return read_object(ASSETS / "bracket" / "bracket.xml")


@pytest.fixture(scope="module")
def candidates(bracket: RigidObject) -> Candidates:
    return make_candidates(bracket, "40", None, seed=0)


def test_fingers_of_one_mask_and_strength_are_one_kind(bracket: RigidObject, candidates: Candidates) -> None:
    tables = Finger(geoms=UPRIGHT), Finger(strength=2), Finger(geoms=("up*",)), Finger(), Finger(strength=2.0)
    kinds = finger_kinds(bracket, candidates, 5, Limits(fingers=tables))
    upright = [bracket.parts[part].geom == "upright" for part in candidates.part]
    assert kinds.kinds == (
        FingerKind(fingers=2, candidates=sum(upright)),  # two ways to say the same geoms
        FingerKind(fingers=2, candidates=40, strength=2.0),
        FingerKind(fingers=1, candidates=40),
    )
    assert kinds.of_finger.tolist() == [0, 1, 0, 2, 1]
    points = candidates.contacts.points
    np.testing.assert_array_equal(kinds.candidates.contacts.points, np.concatenate([points[upright], points, points]))


def test_every_finger_gets_a_contact_of_its_own_kind(bracket: RigidObject, candidates: Candidates) -> None:
    tables = Finger(strength=2), Finger(geoms=UPRIGHT), Finger(strength=2), Finger(geoms=UPRIGHT)
    kinds = finger_kinds(bracket, candidates, 4, Limits(fingers=tables))
    strong = kinds.kinds[0].candidates
    for subset in map(np.array, permutations((3, 7, strong, strong + 2))):
        ordered = subset[kinds.in_finger_order(subset)]
        assert ordered.tolist() == [3, strong, 7, strong + 2]


def test_fingers_that_are_all_alike_need_no_kinds(bracket: RigidObject, candidates: Candidates) -> None:
    for limits in (Limits(), Limits(fingers=(Finger(), Finger(strength=1)))):
        kinds = finger_kinds(bracket, candidates, 2, limits)
        assert kinds.kinds == ()
        np.testing.assert_array_equal(kinds.candidates.contacts.points, candidates.contacts.points)
    both = finger_kinds(bracket, candidates, 2, Limits(fingers=(Finger(geoms=UPRIGHT),) * 2))
    assert both.kinds == ()
    assert {bracket.parts[part].geom for part in both.candidates.part} == {"upright"}
    strong = finger_kinds(bracket, candidates, 2, Limits(fingers=(Finger(strength=3),) * 2))
    assert strong.kinds == (FingerKind(fingers=2, candidates=40, strength=3.0),)


def test_a_kind_carries_its_torsional_friction_in_place_of_the_candidates_own(
    bracket: RigidObject, candidates: Candidates
) -> None:
    soft = candidates.twisting(0.002, None)
    tables = Finger(), Finger(torsion=0.0035), Finger(patch=0.004), Finger(torsion=0), Finger(torsion=0.0035)
    kinds = finger_kinds(bracket, soft, 5, Limits(fingers=tables))
    assert kinds.kinds == tuple(FingerKind(fingers=count, candidates=40) for count in (1, 2, 1, 1))
    assert kinds.of_finger.tolist() == [0, 1, 2, 3, 1]
    own, stated, pad, hard = np.split(kinds.candidates.contacts.torsions, 4)
    assert own == pytest.approx(0.002) and stated == pytest.approx(0.0035) and not hard.any()
    assert pad == pytest.approx(2 / 3 * candidates.contacts.friction * 0.004)


def test_fingers_are_alike_by_the_torsional_friction_that_they_have_however_it_is_said(
    bracket: RigidObject, candidates: Candidates
) -> None:
    said = Finger(torsion=0), Finger(patch=0), Finger()
    assert finger_kinds(bracket, candidates, 3, Limits(fingers=said)).kinds == ()
    pads = finger_kinds(bracket, candidates, 2, Limits(fingers=(Finger(patch=0.004),) * 2))
    assert pads.kinds == ()
    np.testing.assert_array_equal(pads.candidates.contacts.torsions, candidates.twisting(None, 0.004).contacts.torsions)


def test_the_friction_error_is_taken_off_the_fingers_torsional_friction_too(
    bracket: RigidObject, candidates: Candidates
) -> None:
    tables = Finger(torsion=0.003), Finger(patch=0.003)
    kinds = finger_kinds(bracket, candidates.least_friction(0.2), 2, Limits(fingers=tables))
    stated, pad = np.split(kinds.candidates.contacts.torsions, 2)
    assert stated == pytest.approx(0.0024)
    assert pad == pytest.approx(0.8 * 2 / 3 * candidates.contacts.friction * 0.003)


@pytest.mark.parametrize(
    ("limits", "error", "message"),
    [
        (Limits(fingers=(Finger(),)), LimitsError, r"1 tables \[\[finger\]\] for 3 fingers"),
        (Limits(spacing=0.5), LimitsError, "no two of the 40 candidates are more than 0.1[0-9]+ m apart"),
        (Limits(span=1e-5), LimitsError, "no two of the 40 candidates are less than 0.0[0-9]+ m apart"),
        (Limits(fingers=(Finger(within=Zone(lower=(5, 5, 5), upper=(6, 6, 6))),) * 3), CandidateError, "may use none"),
    ],
)
def test_limits_that_leave_nothing_to_search_are_refused(
    bracket: RigidObject, candidates: Candidates, limits: Limits, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        finger_kinds(bracket, candidates, 3, limits)


def test_more_fingers_of_a_kind_than_candidates_are_refused(bracket: RigidObject, candidates: Candidates) -> None:
    highest = float(candidates.contacts.points[:, 2].max())
    few = Finger(within=Zone(lower=(-1, -1, highest), upper=(1, 1, 1)))
    count = int((candidates.contacts.points[:, 2] == highest).sum())
    tables = (few,) * (count + 1)
    with pytest.raises(CandidateError, match=f"{count + 1} fingers of one kind but {count} candidates"):
        finger_kinds(bracket, candidates, count + 1, Limits(fingers=tables))


def test_one_finger_has_no_neighbour_to_keep_a_distance_to(bracket: RigidObject, candidates: Candidates) -> None:
    assert finger_kinds(bracket, candidates, 1, Limits(spacing=0.5)).kinds == ()
