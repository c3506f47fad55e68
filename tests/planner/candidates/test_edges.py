"""Candidates on the edges of planar objects: how many, how far apart, and never on a corner."""

from pathlib import Path

import numpy as np
import pytest

from planner.arrays import Floats, Indices
from planner.candidates.choice import make_candidates
from planner.candidates.edges import edge_candidates, edge_grid
from planner.errors import CandidateError
from planner.objects.object_file import read_object_file
from planner.objects.planar.planar_object import PlanarObject
from tests.strategies.planar_objects import HOOK, RECTANGLE, planar_object, star
from tests.tools.commands import ASSETS


def asset(name: str) -> PlanarObject:
    planar = read_object_file(ASSETS / "planar" / f"{name}.toml")
    assert isinstance(planar, PlanarObject)
    return planar


def positions(planar: PlanarObject, points: Floats, edges: Indices) -> Floats:
    """Distances of points on given edges from corner 0 along the outline [m]."""
    before = np.concatenate([[0.0], planar.outline.lengths.cumsum()])
    return before[edges] + np.linalg.norm(points - planar.outline.corners[edges], axis=1)


@pytest.mark.parametrize(("name", "count", "per_edge"), [
    ("convex", 56, [16, 8, 10, 8, 14]),
    ("concave", 86, [6, 4, 13, 4, 12, 4, 12, 4, 13, 4, 6, 4]),
])  # fmt: skip
def test_our_planar_cases_get_the_centers_of_five_millimetre_cells(name: str, count: int, per_edge: list[int]) -> None:
    planar = asset(name)
    even = make_candidates(planar, str(count), 0.3, seed=0)
    assert np.bincount(even.facet).tolist() == per_edge
    along = positions(planar, even.contacts.points, even.facet)
    np.testing.assert_allclose(along, 0.005 * (np.arange(count) + 0.5), atol=1e-12)
    grid = make_candidates(planar, "grid:0.005", 0.3, seed=0)
    np.testing.assert_allclose(grid.contacts.points, even.contacts.points, atol=1e-12)


@pytest.mark.parametrize("count", [1, 2, 3, 5, 40, 1001])
@pytest.mark.parametrize("seed", range(8))
def test_even_candidates_are_equally_far_apart_and_off_the_corners(seed: int, count: int) -> None:
    planar = planar_object([tuple(corner) for corner in star(seed).tolist()])
    candidates = edge_candidates(planar, count, None)
    perimeter = planar.outline.lengths.sum()
    along = positions(planar, candidates.contacts.points, candidates.facet)
    assert len(candidates) == count
    assert 0 < along[0] < perimeter / count
    np.testing.assert_allclose(np.diff(along), perimeter / count, rtol=1e-9)
    corners = planar.outline.corners
    nearest = np.linalg.norm(candidates.contacts.points[:, None] - corners, axis=2).min()
    along_corners = np.abs(along[:, None] - np.concatenate([[0.0], planar.outline.lengths.cumsum()])).min()
    assert along_corners >= perimeter / count / (2 * len(corners)) * (1 - 1e-9)
    assert nearest > 0


def test_where_cell_centers_would_hit_a_corner_the_cells_are_shifted() -> None:
    """Half of seven cells end at half the perimeter, which is a corner of a rectangle."""
    planar = planar_object(RECTANGLE)
    candidates = edge_candidates(planar, 7, None)
    assert min(planar.outline.corner_distance(point) for point in candidates.contacts.points) > 0.002


@pytest.mark.parametrize("choice", ["60", "grid:0.25"])
def test_candidates_lie_on_their_edges_and_push_inward(choice: str) -> None:
    planar = planar_object(HOOK)
    candidates = make_candidates(planar, choice, None, seed=0)
    points, normals = candidates.contacts.points, candidates.contacts.normals
    np.testing.assert_allclose(planar.outline.depth(points), 0, atol=1e-12)
    np.testing.assert_allclose(planar.outline.depth(points + 1e-3 * normals), 1e-3, rtol=1e-9)
    np.testing.assert_array_equal(planar.outline.nearest_facet(points), candidates.facet)
    assert (candidates.part == 0).all()
    assert (candidates.contacts.friction == 0.7).all()


def test_listed_points_get_the_normal_of_their_edge(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("x,y\n0.03,0.01\n-0.01,-0.02  # below\n")
    listed = make_candidates(planar_object(RECTANGLE), str(path), 0.2, seed=0)
    np.testing.assert_allclose(listed.contacts.points, [(0.03, 0.01), (-0.01, -0.02)])
    np.testing.assert_allclose(listed.contacts.normals, [(-1, 0), (0, 1)])
    assert listed.facet.tolist() == [1, 0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.03,0.01,0\n", "expected finite numbers x,y"),
        ("0.03\n", "expected finite numbers x,y"),
        ("0.02,0.01\n", r"point 1 of 1, \(0.02, 0.01\), lies 0.01 m inside"),
        ("0.04,0.01\n", r"lies 0.01 m off"),
        ("# nothing\n", "write x,y in every line"),
    ],
)
def test_listed_points_off_the_outline_are_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "points.csv"
    path.write_text(text)
    with pytest.raises(CandidateError, match=message):
        make_candidates(planar_object(RECTANGLE), str(path), 0.2, seed=0)


@pytest.mark.parametrize(
    ("choice", "friction", "message"),
    [
        ("0", 0.3, "0 candidates"),
        ("1000001", 0.3, "choose 1 to 1000000"),
        ("56", 0.0, "friction given is 0; it must be positive and at most 1000"),
        ("grid:0", 0.3, "spacing is 0.0"),
        ("grid:nan", 0.3, "spacing is nan"),
        ("grid:1e-9", 0.3, "more than 1000000 cells"),
        ("case3", 0.3, "case3 lists points in space"),
        ("nowhere.csv", 0.3, "neither known nor a file"),
    ],
)
def test_other_choices_are_refused(choice: str, friction: float, message: str) -> None:
    with pytest.raises(CandidateError, match=message):
        make_candidates(planar_object(RECTANGLE), choice, friction, seed=0)


def test_a_grid_too_fine_for_its_many_edges_is_refused() -> None:
    """Each of 12 edges alone stays below the limit."""
    planar = planar_object([tuple(corner) for corner in star(0).tolist()])
    with pytest.raises(CandidateError, match="more than 1000000 cells"):
        edge_grid(planar, 1.5 * planar.size / 1e6, 0.3)
