"""Which candidates each finger may use."""

import pytest

from planner.candidates.candidates import Candidates
from planner.candidates.choice import make_candidates
from planner.errors import CandidateError, LimitsError
from planner.limits.fingers import finger_masks, require_finger_count
from planner.limits.limits import Finger, Limits, Zone
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from tests.tools.commands import ASSETS

ABOVE = Zone(lower=(-1, -1, 0.01), upper=(1, 1, 1))


@pytest.fixture(scope="module")
def bracket() -> RigidObject:
    return read_object(ASSETS / "bracket" / "bracket.xml")


@pytest.fixture(scope="module")
def candidates(bracket: RigidObject) -> Candidates:
    return make_candidates(bracket, "60", None, seed=0)


def test_a_finger_keeps_to_its_geoms_and_its_box(bracket: RigidObject, candidates: Candidates) -> None:
    fingers = Finger(), Finger(geoms=("base", "none*")), Finger(within=ABOVE), Finger(geoms=("up*",), within=ABOVE)
    masks = finger_masks(bracket, candidates, Limits(fingers=fingers))
    for index, (point, part) in enumerate(zip(candidates.contacts.points, candidates.part, strict=True)):
        on_base, high = bracket.parts[part].geom == "base", point[2] >= 0.01
        assert masks[:, index].tolist() == [True, on_base, high, high and not on_base]
    assert masks.dtype == bool
    assert (masks[1:].sum(axis=1) > 0).all()
    assert (masks[1:].sum(axis=1) < len(candidates)).all()


def test_without_tables_there_are_no_rows(bracket: RigidObject, candidates: Candidates) -> None:
    assert finger_masks(bracket, candidates, Limits()).shape == (0, len(candidates))


def test_a_finger_with_nowhere_to_go_is_named(bracket: RigidObject, candidates: Candidates) -> None:
    limits = Limits(fingers=(Finger(), Finger(geoms=("base",), within=ABOVE)))
    with pytest.raises(CandidateError, match="finger 2 may use none of the 60 candidates"):
        finger_masks(bracket, candidates, limits)


def test_there_is_a_table_for_every_finger_or_none() -> None:
    require_finger_count(Limits(), 3)
    require_finger_count(Limits(fingers=(Finger(), Finger())), 2)
    with pytest.raises(LimitsError, match=r"2 tables \[\[finger\]\] for 3 fingers"):
        require_finger_count(Limits(fingers=(Finger(), Finger())), 3)
