"""Candidates that MuJoCo does not confirm are left out and counted."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.candidates.confirmed import confirmed_candidates
from planner.errors import CandidateError
from planner.objects.mjcf.reader import read_object
from tests.strategies.cups import HALF, WALL, box_cup
from tests.strategies.mjcf_files import EVERY_SHAPE, shared_object, written


def test_candidates_on_every_kind_of_geom_are_confirmed(tmp_path: Path) -> None:
    thing = read_object(written(tmp_path, EVERY_SHAPE))
    confirmed = confirmed_candidates(thing, make_candidates(thing, "200", None, seed=1))
    assert (len(confirmed.candidates), confirmed.dropped) == (200, 0)


def test_a_surface_that_is_not_mujocos_is_noticed_to_a_millionth_of_the_size(tmp_path: Path) -> None:
    thing = read_object(box_cup(tmp_path))
    candidates = make_candidates(thing, "40", None, seed=0)
    contacts = candidates.contacts
    lifts, turns = np.zeros(40), np.zeros(40)
    lifts[:4], turns[4:7] = 1e-5 * thing.size * np.array([1, -1, 2, 0.01]), np.deg2rad(0.2)
    across = np.roll(contacts.normals, 1, axis=1)  # the faces lie along the axes
    moved = replace(
        contacts,
        points=contacts.points - lifts[:, None] * contacts.normals,
        normals=np.cos(turns)[:, None] * contacts.normals + np.sin(turns)[:, None] * across,
    )
    confirmed = confirmed_candidates(thing, replace(candidates, contacts=moved))
    assert (confirmed.off_surface, confirmed.turned, confirmed.crowded) == (3, 3, 0)
    np.testing.assert_array_equal(confirmed.candidates.contacts.points, moved.points[[3, *range(7, 40)]])
    assert confirmed.largest_turn < 1e-6


def test_a_listed_point_against_another_wall_is_left_out(tmp_path: Path) -> None:
    thing = read_object(box_cup(tmp_path))
    inner, floor = HALF - WALL, WALL - HALF
    points = tmp_path / "points.csv"
    points.write_text(f"0,0,{floor}\n{inner - 1e-5},0,{floor}\n")
    confirmed = confirmed_candidates(thing, make_candidates(thing, str(points), None, seed=0))
    assert (len(confirmed.candidates), confirmed.crowded) == (1, 1)


def test_nothing_left_is_an_error(tmp_path: Path) -> None:
    thing = read_object(box_cup(tmp_path))
    candidates = make_candidates(thing, "5", None, seed=0)
    elsewhere = replace(candidates.contacts, points=candidates.contacts.points + 0.01)
    with pytest.raises(CandidateError, match=r"confirms none of the 5 candidates: .*grasp-inspect"):
        confirmed_candidates(thing, replace(candidates, contacts=elsewhere))


def test_a_thousand_candidates_on_33_boxes_are_confirmed() -> None:
    thing = read_object(shared_object("mujoco_mug/mug.xml"))
    assert confirmed_candidates(thing, make_candidates(thing, "1000", None, seed=0)).dropped == 0


def test_a_larger_fingertip_needs_more_room(tmp_path: Path) -> None:
    thing = read_object(box_cup(tmp_path))
    points = make_candidates(thing, "300", None, seed=0, fingertip=0.01).contacts.points
    inner, floor = HALF - WALL, WALL - HALF
    on_floor = points[np.abs(points[:, 2] - floor) < 1e-9]
    assert len(on_floor) > 3
    assert np.abs(on_floor[:, :2]).max() < inner - 0.01 + 1e-6
    for fingertip, choice, message in ((-1.0, "9", "-1.0 m"), (np.nan, "9", "nan"), (0.01, "case3", "listed points")):
        with pytest.raises(CandidateError, match=message):
            make_candidates(thing, choice, None, seed=0, fingertip=fingertip)
