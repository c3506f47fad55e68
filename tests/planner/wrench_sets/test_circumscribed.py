"""Polytopes around the unit ball, judged by the hull of their vertices."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from planner.errors import TaskError
from planner.wrench_sets.circumscribed import circumscribed_ball

POLYTOPES = [
    *[(2, facets) for facets in (3, 4, 7, 8, 20, 200)],
    *[(3, facets) for facets in (6, 8, 10, 12, 20, 24, 60)],
    *[(4, facets) for facets in (8, 16, 24, 50)],
    *[(5, facets) for facets in (10, 32, 40)],
    *[(6, facets) for facets in (12, 64, 24, 84)],
]


@pytest.mark.parametrize(("dimension", "facets"), POLYTOPES)
def test_every_facet_touches_the_ball_and_there_are_as_many_as_asked_for(dimension: int, facets: int) -> None:
    vertices = circumscribed_ball(dimension, facets)
    equations = ConvexHull(vertices).equations
    normals = np.unique(np.round(equations[:, :-1], 6) + 0.0, axis=0)
    assert len(normals) == facets
    np.testing.assert_allclose(-equations[:, -1], 1, atol=1e-9)
    assert len(np.unique(np.round(vertices, 6), axis=0)) == len(vertices)


@pytest.mark.parametrize(("dimension", "facets"), [(k, f) for k, f in POLYTOPES if f % 2 == 0])
def test_the_polytope_is_its_own_mirror_image(dimension: int, facets: int) -> None:
    vertices = np.round(circumscribed_ball(dimension, facets), 6) + 0.0
    mirrored = np.round(-vertices, 6) + 0.0
    np.testing.assert_array_equal(np.unique(vertices, axis=0), np.unique(mirrored, axis=0))


@pytest.mark.parametrize("facets", [4, 8, 20])
def test_a_polygon_has_a_flat_on_each_axis_when_four_divides_its_facets(facets: int) -> None:
    vertices = circumscribed_ball(2, facets)
    np.testing.assert_allclose(vertices.max(axis=0), 1, atol=1e-12)
    np.testing.assert_allclose(vertices.min(axis=0), -1, atol=1e-12)


def test_an_interval_is_its_two_ends() -> None:
    np.testing.assert_array_equal(circumscribed_ball(1), [[-1], [1]])


@pytest.mark.parametrize(
    ("dimension", "vertices", "radius"),
    [(2, 8, 1 / np.cos(np.pi / 8)), (3, 12, np.sqrt(15 - 6 * np.sqrt(5))), (4, 8, 2), (6, 12, np.sqrt(6))],
)
def test_the_default_polytope_sticks_out_as_far_as_geometry_books_say(
    dimension: int, vertices: int, radius: float
) -> None:
    """Circumradius over inradius of the octagon, the icosahedron and the cross-polytopes."""
    polytope = circumscribed_ball(dimension)
    assert len(polytope) == vertices
    np.testing.assert_allclose(np.linalg.norm(polytope, axis=1), radius)


def test_more_facets_stick_out_less() -> None:
    radii = [np.linalg.norm(circumscribed_ball(3, facets), axis=1).max() for facets in (8, 20, 32, 60, 100)]
    assert radii == sorted(radii, reverse=True)
    assert radii[-1] < 1.05


@pytest.mark.parametrize(
    ("dimension", "facets", "message"),
    [
        (1, 3, "2 ends, not 3"),
        (2, 2, "3 to 200 facets, got 2"),
        (2, 201, "3 to 200 facets, got 201"),
        (3, 4, "6 to 200 facets, got 4"),
        (3, 9, "even number of facets: 9"),
        (3, 0, "got 0"),
        (6, -12, "got -12"),
        (6, 200, "at most 4096 are allowed: ask for fewer"),
    ],
)
def test_impossible_facets_are_refused(dimension: int, facets: int, message: str) -> None:
    with pytest.raises(TaskError, match=message):
        circumscribed_ball(dimension, facets)
