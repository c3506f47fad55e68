"""Grids of planar facets."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.candidates.case3 import case3_points
from planner.candidates.grid import grid_candidates
from planner.errors import CandidateError
from planner.objects.parts.polyhedron import Polyhedron
from tests.strategies.parts import FRICTION, NAME, PRISM_CORNERS, box, rigid_object, tilted_parts


def as_set(points: Floats) -> set[tuple[float, ...]]:
    return {tuple(point) for point in np.round(points, 9) + 0.0}


def test_a_box_gets_the_cell_centres_of_its_faces() -> None:
    points = grid_candidates(rigid_object(box((2, 1, 0.5))), 1.0, 0.5).contacts.points
    assert len(points) == 2 * (4 * 2 + 2 * 1 + 4 * 1)
    top = {(x, y, 0.5) for x in (-1.5, -0.5, 0.5, 1.5) for y in (-0.5, 0.5)}
    assert top <= as_set(points)


def test_a_coarse_grid_keeps_one_cell_per_face() -> None:
    points = grid_candidates(rigid_object(box((2, 1, 0.5))), 100.0, 0.5).contacts.points
    assert as_set(points) == {(2, 0, 0), (-2, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 0.5), (0, 0, -0.5)}


def test_the_papers_caps_are_the_grid_of_a_ninth_of_the_leg() -> None:
    prism = rigid_object(Polyhedron.hull(0.01 * PRISM_CORNERS, geom=NAME, friction=FRICTION))
    points = grid_candidates(prism, 0.04 / 9, None).contacts.points
    caps = as_set(points[np.isclose(np.abs(points[:, 2]), 0.01)])
    assert caps == as_set(case3_points()[-72:])


def test_centres_inside_other_parts_are_left_out() -> None:
    plus = rigid_object(box((3, 1, 1)), box((1, 3, 1)))
    candidates = grid_candidates(plus, 2.0, None)
    depths = np.max([part.depth(candidates.contacts.points) for part in plus.parts], axis=0)
    assert np.abs(depths).max() < 1e-12
    walls = candidates.contacts.points[np.abs(candidates.contacts.points[:, 2]) < 0.5]
    assert len(walls) == 12  # each arm: two flanks and an end


@pytest.mark.parametrize(
    ("shape", "spacing", "message"),
    [
        ("box", 0.0, "spacing is 0.0"),
        ("box", -1.0, "spacing is -1.0"),
        ("box", np.nan, "spacing is nan"),
        ("box", 1e-6, "more than 1000000"),
        ("box", 1e-300, "more than 1000000"),
        ("sphere", 0.1, "is a sphere"),
        ("capsule", 0.1, "is a capsule"),
    ],
)
def test_grids_that_cannot_be_are_refused(shape: str, spacing: float, message: str) -> None:
    with pytest.raises(CandidateError, match=message):
        grid_candidates(rigid_object(tilted_parts()[shape]), spacing, None)


def test_a_grid_without_points_on_the_surface_is_refused() -> None:
    # every face is right-angled along the grid, so its only centre is the middle of its hypotenuse
    corners = np.cumsum([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]], axis=0)
    with pytest.raises(CandidateError, match="no cell centre"):
        grid_candidates(rigid_object(Polyhedron.hull(corners, geom=NAME, friction=FRICTION)), 10.0, None)
