"""Planar objects from TOML files, and every file that is none."""

from pathlib import Path

import numpy as np
import pytest

from planner.errors import ObjectError
from planner.files.toml_file import MAX_FILE_BYTES
from planner.objects.object_file import read_object_file
from planner.objects.object_source import ObjectSource
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.planar.reader import read_planar
from planner.objects.rigid_object import RigidObject
from tests.strategies.mjcf_files import written
from tests.tools.commands import PRISM

TRIANGLE = """
format = "rhograsp.planar"
name = "wedge"
mass = 0.2
friction = 0.4
outline = [[0, 0], [0.03, 0], [0, 0.04]]
"""


def test_a_file_says_everything_about_the_object(tmp_path: Path) -> None:
    wedge = read_planar(written(tmp_path, TRIANGLE, "wedge.toml"))
    assert (wedge.body, wedge.mass, wedge.file.name) == ("wedge", 0.2, "wedge.toml")
    assert [(part.geom, part.friction) for part in wedge.parts] == [("wedge", 0.4)]
    np.testing.assert_allclose(wedge.center_of_mass, [0.01, 0.04 / 3])
    np.testing.assert_allclose(wedge.extent, [0.03, 0.04])
    assert wedge.size == pytest.approx(0.05)
    assert wedge.thickness == pytest.approx(0.005)
    assert read_planar(written(tmp_path, TRIANGLE + "thickness = 0.002", "wedge.toml")).thickness == 0.002


def test_the_digest_is_that_of_the_content_wherever_the_file_lies(tmp_path: Path) -> None:
    first, second = tmp_path / "a", tmp_path / "b"
    for folder in (first, second):
        folder.mkdir()
    digests = [read_planar(written(folder, TRIANGLE, "w.toml")).sha256 for folder in (first, second)]
    changed = read_planar(written(second, TRIANGLE.replace("0.4", "0.5"), "w.toml")).sha256
    assert digests[0] == digests[1] != changed


def test_a_clockwise_outline_is_the_same_object(tmp_path: Path) -> None:
    there = read_planar(written(tmp_path, TRIANGLE, "there.toml"))
    back = read_planar(written(tmp_path, TRIANGLE.replace("[0.03, 0], [0, 0.04]", "[0, 0.04], [0.03, 0]"), "back.toml"))
    np.testing.assert_array_equal(back.outline.corners, there.outline.corners)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[0.03, 0], ", "", "2 corners"),
        ("[0, 0.04]", "[0, nan]", "corner 2 of 'wedge'"),
        ("[0, 0.04]", "[0.06, 0]", "in line"),
        ("[0, 0.04]", "[0, 0.04], [0.03, 0.04], [0, 0]", "same point"),
        ("[0, 0.04]", "[0, 0.04], [0.03, 0.04]", "meet"),
        ("[0, 0.04]", "[0, 0.04, 0]", r"length 2.*\$.outline"),
        ("[0, 0.04]", "[0, 'a']", r"`float`.*\$.outline"),
        ("[[0, 0], [0.03, 0], [0, 0.04]]", "3", r"\$.outline"),
        ("mass = 0.2", "mass = 0", "mass is 0.0; it must be positive"),
        ("mass = 0.2", "mass = -1", "mass is -1"),
        ("mass = 0.2", "mass = nan", "mass is nan"),
        ("mass = 0.2", "mass = inf", "mass is inf"),
        ("mass = 0.2", "", "mass"),
        ("friction = 0.4", "friction = 0", "friction is 0.0; it must be positive"),
        ("friction = 0.4", "friction = -0.1", "friction is -0.1"),
        ("friction = 0.4", "friction = nan", "friction is nan"),
        ("friction = 0.4", "friction = 0.4\nthickness = 0", "thickness is 0.0; it must be positive"),
        ("friction = 0.4", "friction = 0.4\ndensity = 3", "unknown field `density`"),
        ('"rhograsp.planar"', '"other"', r"Invalid enum value.*\$.format"),
        ("format", "fromat", "fromat|format"),
        ("outline", "outline = [", "not a planar object"),
    ],
)
def test_other_files_are_refused_with_a_reason(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in TRIANGLE
    with pytest.raises(ObjectError, match=message):
        read_planar(written(tmp_path, TRIANGLE.replace(old, new, 1), "bad.toml"))


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ObjectError, match=r"nowhere\.toml' cannot be read"):
        read_planar(tmp_path / "nowhere.toml")
    with pytest.raises(ObjectError, match="cannot be read"):
        read_planar(Path("\0.toml"))
    with pytest.raises(ObjectError, match="larger than"):
        read_planar(written(tmp_path, TRIANGLE + "#" * MAX_FILE_BYTES, "long.toml"))
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ObjectError, match="not a planar object"):
        read_planar(tmp_path / "binary.toml")
    with pytest.raises(ObjectError, match="not a planar object"):
        read_planar(written(tmp_path, "outline = " + 5000 * "[", "deep.toml"))


def test_what_a_file_is_decides_how_it_is_read(tmp_path: Path) -> None:
    wedge = written(tmp_path, TRIANGLE, "wedge.toml")
    assert isinstance(read_object_file(wedge), PlanarObject)
    assert isinstance(read_object_file(ObjectSource(file=wedge, body="wedge")), PlanarObject)
    assert isinstance(read_object_file(PRISM), RigidObject)
    with pytest.raises(ObjectError, match=r"no body 'lid'.*one, 'wedge'"):
        read_object_file(ObjectSource(file=wedge, body="lid"))
