"""The outline as a surface: where is the nearest edge, what is inside, where is the centre."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.objects.planar.outline import Outline
from tests.strategies.planar_objects import HOOK, planar_object, star

HOOKED = planar_object(HOOK).outline


def outline(seed: int) -> Outline:
    return Outline(geom="star", friction=0.5, corners=star(seed))


def winding(corners: Floats, point: Floats) -> int:
    """How often the outline turns about a point, by adding angles."""
    arms = (corners - point) @ [1, 1j]
    return round(float(np.angle(np.roll(arms, -1) / arms).sum()) / (2 * np.pi))


@pytest.mark.parametrize("seed", range(5))
def test_depth_is_the_distance_to_a_dense_sample_of_the_outline_positive_inside(seed: int) -> None:
    shape = outline(seed)
    fractions = np.linspace(0, 1, 2001)[:, None]
    sample = np.concatenate([start + fractions * edge for start, edge in zip(shape.corners, shape.edges, strict=True)])
    points = np.random.default_rng(seed).uniform(-1, 1, size=(60, 2))
    depths = shape.depth(points)
    for point, depth in zip(points, depths, strict=True):
        assert abs(depth) == pytest.approx(np.linalg.norm(sample - point, axis=1).min(), abs=1e-3)
        assert (depth > 0) == (winding(shape.corners, point) == 1)


def test_a_point_beside_an_edge_is_projected_onto_it_with_the_normal_inward() -> None:
    for edge in range(len(HOOKED.corners)):
        middle = HOOKED.corners[edge] + 0.4 * HOOKED.edges[edge]
        for side in (-0.2, 0.2):
            beside = (middle + side * HOOKED.normals[edge])[None]
            assert HOOKED.nearest_facet(beside) == [edge]
            feet, normals = HOOKED.project(beside, np.array([edge]))
            np.testing.assert_allclose(feet[0], middle, atol=1e-12)
            assert HOOKED.depth(feet + 0.1 * normals)[0] == pytest.approx(0.1)


def test_a_point_beyond_the_end_of_an_edge_is_projected_onto_its_corner() -> None:
    feet, _ = HOOKED.project(np.array([[9.0, -1.0]]), np.array([0]))
    np.testing.assert_array_equal(feet, [[4, 0]])


def test_no_points_are_no_facets() -> None:
    assert HOOKED.nearest_facet(np.empty((0, 2))).shape == HOOKED.depth(np.empty((0, 2))).shape == (0,)


def test_area_and_centroid_of_the_hook_are_those_of_its_three_rectangles() -> None:
    areas = np.array([4.0, 2.0, 1.0])
    centers = np.array([(2, 0.5), (3.5, 2), (0.5, 1.5)])
    assert HOOKED.area == pytest.approx(areas.sum())
    np.testing.assert_allclose(HOOKED.centroid, areas @ centers / areas.sum())


@pytest.mark.parametrize("seed", range(5))
def test_area_and_centroid_do_not_depend_on_where_the_frame_is(seed: int) -> None:
    here, far = outline(seed), Outline(geom="star", friction=0.5, corners=star(seed) + 1e4)
    assert far.area == pytest.approx(here.area, rel=1e-6)
    np.testing.assert_allclose(far.centroid - 1e4, here.centroid, atol=1e-6)


def test_the_nearest_corner_counts_and_not_the_nearest_edge() -> None:
    assert HOOKED.corner_distance(np.array([2.0, 0.0])) == pytest.approx(np.sqrt(2))
