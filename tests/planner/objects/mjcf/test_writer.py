"""An object written as MJCF is read back as the same object."""

from pathlib import Path

import numpy as np
import pytest

from planner.objects.mjcf.reader import read_object
from planner.objects.mjcf.visual import visual_difference
from planner.objects.mjcf.writer import write_mjcf
from tests.strategies.cups import cup_mesh
from tests.strategies.mjcf_files import EVERY_SHAPE, world, written


def test_parts_friction_mass_and_frame_come_back(tmp_path: Path) -> None:
    thing = read_object(written(tmp_path, EVERY_SHAPE))
    write_mjcf(tmp_path / "written.xml", thing, np.zeros((0, 3, 3)))
    again = read_object(tmp_path / "written.xml")
    assert again.body == thing.body
    for part, copy in zip(thing.parts, again.parts, strict=True):
        assert (type(copy), copy.geom, copy.friction) == (type(part), part.geom, part.friction)
        np.testing.assert_allclose(copy.bounds(), part.bounds(), atol=1e-7)
    assert again.mass == pytest.approx(thing.mass)
    np.testing.assert_allclose(again.center_of_mass, thing.center_of_mass, atol=1e-12)
    np.testing.assert_allclose(again.inertia, thing.inertia, rtol=1e-9, atol=1e-9 * thing.inertia.max())


def test_what_is_only_seen_stays_seen_and_an_object_may_weigh_nothing(tmp_path: Path) -> None:
    text = world('<body name="a&amp;b"><geom type="box" size=".04 .04 .04" mass="0"/></body>')
    thing = read_object(written(tmp_path, text))
    write_mjcf(tmp_path / "written.xml", thing, cup_mesh().triangles)
    again = read_object(tmp_path / "written.xml")
    assert (again.body, again.mass, len(again.parts)) == ("a&b", 0.0, 1)
    difference = visual_difference(again)
    assert difference is not None
    assert difference.largest == pytest.approx(0.008, rel=0.2)
