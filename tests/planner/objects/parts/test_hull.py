"""Facets of hulls: merged, canonical, and refused where they mean nothing."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.errors import ObjectError
from planner.objects.parts.hull import convex_facets
from tests.strategies.parts import PRISM_CORNERS, TILTED


def drum(sides: int) -> Floats:
    angles = np.arange(sides) * 2 * np.pi / sides
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    rim = [np.column_stack([ring, np.full(sides, z)]) for z in (-0.3, 0.3)]
    return TILTED.to_body(np.concatenate([*rim, [[0, 0, 0.3], [0.5, 0, -0.3], [0, 0, 0]]]))


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("precision", [np.float32, np.float64])
def test_triangles_of_one_flat_face_are_one_facet(scale: float, precision: type) -> None:
    facets = convex_facets((scale * drum(32)).astype(precision).astype(float), "drum")
    assert sorted(len(polygon) for polygon in facets.polygons) == [4] * 32 + [32] * 2
    assert len(facets.vertices) == 64


def test_a_lump_keeps_every_face() -> None:
    points = np.random.default_rng(0).normal(size=(200, 3))
    facets = convex_facets(points / np.linalg.norm(points, axis=1)[:, None], "ball")
    assert len(facets.vertices) == 200
    assert len(facets.polygons) == 2 * 200 - 4  # Euler, all triangles


def test_facets_do_not_depend_on_the_order_of_the_vertices() -> None:
    points = np.concatenate([drum(12), drum(12)])
    first = convex_facets(points, "drum")
    for seed in range(5):
        again = convex_facets(np.random.default_rng(seed).permutation(points), "drum")
        assert [polygon.tolist() for polygon in again.polygons] == [polygon.tolist() for polygon in first.polygons]
        np.testing.assert_allclose(again.vertices, first.vertices, atol=1e-15)
        np.testing.assert_allclose(again.outward_normals, first.outward_normals, atol=1e-14)


def test_the_prism_has_its_five_planes() -> None:
    facets = convex_facets(PRISM_CORNERS, "prism")
    diagonal = np.sqrt(0.5)
    expected = [
        ((-1, 0, 0), 4 / 3),
        ((0, -1, 0), 4 / 3),
        ((0, 0, -1), 1),
        ((0, 0, 1), 1),
        ((diagonal, diagonal, 0), 2 * np.sqrt(2) / 3),
    ]
    np.testing.assert_allclose(facets.outward_normals, [normal for normal, _ in expected], atol=1e-14)
    np.testing.assert_allclose(facets.offsets, [offset for _, offset in expected], atol=1e-14)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]), "degenerate"),
        (np.zeros((5, 3)), "degenerate"),
        (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), "degenerate"),
        (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1e-6]]), "'g' is flat"),
        (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, np.nan]]), "not finite"),
    ],
)
def test_points_that_span_no_volume_are_refused(points: Floats, message: str) -> None:
    with pytest.raises(ObjectError, match=message):
        convex_facets(points, "g")
