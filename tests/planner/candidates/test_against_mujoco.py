"""Candidate points and normals are those that MuJoCo's own collision detection reports."""

from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.objects.mjcf.reader import read_object
from tests.strategies.mjcf_files import EVERY_SHAPE, SHARED_OBJECTS, shared_object, written
from tests.strategies.overlapping_parts import OVERLAPPING
from tests.tools.fingertip import Fingertip
from tests.tools.lanes import first_fast


def check(path: Path, count: int) -> None:
    thing = read_object(path)
    candidates = make_candidates(thing, str(count), 0.5, seed=3)
    fingertip = Fingertip(path, thing)
    measured = [fingertip.measure(candidates, index) for index in range(count)]
    heights = np.array([height for height, _ in measured])
    directions = np.array([direction for _, direction in measured])
    turns = np.linalg.norm(directions - candidates.contacts.normals, axis=1)
    assert np.abs(heights).max() < 1e-6 * thing.size
    assert turns.max() < np.deg2rad(0.1)


@pytest.mark.parametrize("text", [EVERY_SHAPE, OVERLAPPING], ids=["every_shape", "overlapping"])
def test_every_kind_of_geom_agrees(tmp_path: Path, text: str) -> None:
    check(written(tmp_path, text), 300)


@pytest.mark.parametrize("name", first_fast(SHARED_OBJECTS, fast=2))
def test_shared_objects_agree(name: str) -> None:
    check(shared_object(name), 60)
