"""Points from the user: read strictly, placed exactly, refused when off the surface."""

from pathlib import Path

import numpy as np
import pytest

from planner.candidates.even import even_candidates
from planner.candidates.listed import listed_candidates, read_points
from planner.errors import CandidateError
from tests.strategies.parts import box, rigid_object, tilted_parts

EVERYTHING = rigid_object(*tilted_parts().values())


@pytest.mark.parametrize("index", range(len(EVERYTHING.parts)))
def test_points_of_the_surface_find_their_part_facet_and_normal(index: int) -> None:
    thing = rigid_object(EVERYTHING.parts[index])
    known = even_candidates(thing, 200, None, seed=0)
    found = listed_candidates(thing, known.contacts.points)
    assert (found.facet == known.facet).all()
    np.testing.assert_allclose(found.contacts.points, known.contacts.points, atol=1e-12)
    np.testing.assert_allclose(found.contacts.normals, known.contacts.normals, atol=1e-9)


def test_points_of_several_parts_find_the_right_one() -> None:
    thing = rigid_object(*EVERYTHING.parts[:5])  # the side of the capsule coincides with the cylinder's
    known = even_candidates(thing, 300, None, seed=0)
    found = listed_candidates(thing, known.contacts.points)
    assert (found.part == known.part).all()
    np.testing.assert_allclose(found.contacts.normals, known.contacts.normals, atol=1e-9)


def test_a_point_on_an_edge_belongs_to_its_first_facet() -> None:
    cube = rigid_object(box((1, 1, 1)))
    edge = listed_candidates(cube, np.array([[1.0, 0.3, 1.0]]))
    faces = [cube.parts[0].nearest_facet(np.array([face]))[0] for face in ([1.0, 0.3, 0.0], [0.0, 0.3, 1.0])]
    assert edge.facet.tolist() == [min(faces)]


STEP = rigid_object(box((2, 1, 1)), box((1, 1, 1), (0, 0, 1)))


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ((1.5, 0, 1.0001), r"point 2 of 2, \(1.5, 0, 1.0001\), lies 0.0001 m off"),
        ((1.5, 0, 0.9), r"lies 0.1 m inside"),
        ((0.5, 0, 1.0), r"inside another part"),
        ((5, 5, 5), r"lies .* m off"),
        ((0, 0, -1e9), r"lies 1e\+09 m off"),
    ],
)
def test_points_off_the_outer_surface_are_refused(point: tuple[float, ...], message: str) -> None:
    with pytest.raises(CandidateError, match=message):
        listed_candidates(STEP, np.array([(1.5, 0, 1), point]))


def test_the_tolerance_is_relative_to_the_size() -> None:
    near = np.array([[1.5, 0.0, 1 + 0.9e-6 * STEP.size], [1.5, 0.2, 1 + 1.1e-6 * STEP.size]])
    found = listed_candidates(STEP, near[:1])
    assert found.contacts.points[0, 2] == pytest.approx(1, abs=1e-12)
    with pytest.raises(CandidateError, match="point 1 of 1"):
        listed_candidates(STEP, near[1:])
    assert len(listed_candidates(STEP, near, tolerance=2e-6)) == 2


@pytest.mark.parametrize(
    "text",
    [
        "1,2,3\n4,5,6\n",
        "x,y,z\n1,2,3\n4,5,6",
        "\ufeffx [m], y, z\n# note\n 1, 2, 3 # here\n\n4,5,6\r\n",
        "1e0,+2,3.\n4,5,6",
    ],
)
def test_files_of_points_are_read(tmp_path: Path, text: str) -> None:
    path = tmp_path / "points.csv"
    path.write_text(text, encoding="utf-8")
    assert read_points(path).points.tolist() == [[1, 2, 3], [4, 5, 6]]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "lists no points"),
        (b"x,y,z\n", "lists no points"),
        (b"1,2,3\n4,5\n", "line 2 .*'4,5'"),
        (b"1,2,3\n4,5,6,7\n", "line 2"),
        (b"1,2,nan\n", "line 1"),
        (b"1,2,inf\n", "line 1"),
        (b"1,2,1e999\n", "line 1"),
        (b"1,2,3\nx,y,z\n", "line 2"),
        (b"x,y,z\nx,y,z\n1,2,3", "line 2"),
        (b"1;2;3\n", "line 1"),
        (b"\xff\xfe\x00", "cannot be read"),
        (b'1,2,"3\n', "line 1|cannot"),
    ],
)
def test_files_that_hold_anything_else_are_refused(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "points.csv"
    path.write_bytes(content)
    with pytest.raises(CandidateError, match=message):
        read_points(path)


def test_unreadable_and_oversized_files_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(CandidateError, match="cannot be read"):
        read_points(tmp_path)
    path = tmp_path / "points.csv"
    path.write_text("1,2,3\n" * 50)
    monkeypatch.setattr("planner.candidates.listed.MOST_CANDIDATES", 49)
    with pytest.raises(CandidateError, match="more than 49 points"):
        read_points(path)
    monkeypatch.setattr("planner.candidates.listed.LARGEST_FILE", 100)
    with pytest.raises(CandidateError, match="larger than 100 bytes"):
        read_points(path)
