"""Every convex part: its triangles, projections and depths describe one and the same solid."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.objects.parts.cylinder import BOTTOM, TOP
from planner.objects.rigid_object import ConvexPart
from planner.objects.vectors import norm
from tests.strategies.parts import TILTED, tilted_parts

PARTS = tilted_parts()
every_part = pytest.mark.parametrize("part", PARTS.values(), ids=PARTS.keys())

AREAS = {
    "polyhedron": 0.05**2 * (2 * 8 + 2 * (4 + 4 + 4 * np.sqrt(2))),
    "box": 8 * (0.1 * 0.2 + 0.2 * 0.05 + 0.05 * 0.1),
    "sphere": 4 * np.pi * 0.2**2,
    "cylinder": 2 * np.pi * 0.1 * (0.4 + 0.1),
    "capsule": 2 * np.pi * 0.1 * (0.4 + 0.2),
}


def implicit(name: str, local: Floats) -> Floats:
    """Negative inside, positive outside, written from the shape's definition in its own frame."""
    x, y, z = local.T
    values: dict[str, Floats] = {
        "polyhedron": np.max([-x - 0.2 / 3, -y - 0.2 / 3, x + y - 0.2 / 3, np.abs(z) - 0.05], axis=0),
        "box": np.max([np.abs(x) - 0.1, np.abs(y) - 0.2, np.abs(z) - 0.05], axis=0),
        "sphere": x**2 + y**2 + z**2 - 0.04,
        "ellipsoid": (x / 0.3) ** 2 + (y / 0.1) ** 2 + (z / 0.05) ** 2 - 1,
        "cylinder": np.maximum(x**2 + y**2 - 0.01, np.abs(z) - 0.2),
        "capsule": x**2 + y**2 + np.maximum(np.abs(z) - 0.2, 0) ** 2 - 0.01,
    }
    return values[name]


def random_points(part: ConvexPart, count: int, seed: int) -> Floats:
    lower, upper = part.bounds()
    return np.random.default_rng(seed).uniform(lower - 0.1, upper + 0.1, (count, 3))


@pytest.mark.parametrize("name", PARTS)
def test_depth_is_positive_exactly_inside(name: str) -> None:
    points = random_points(PARTS[name], 4000, 1)
    inside = implicit(name, TILTED.to_local(points)) < 0
    assert 100 < inside.sum() < 3900
    assert ((PARTS[name].depth(points) > 0) == inside).all()


@every_part
def test_no_surface_point_is_nearer_than_the_depth(part: ConvexPart) -> None:
    points = random_points(part, 300, 2)
    depths = part.depth(points)
    points, depths = points[depths > 0], depths[depths > 0]
    surface = part.triangles()[0].reshape(-1, 3)
    assert (norm(points[:, None] - surface).min(axis=1) >= depths - 1e-12).all()


@every_part
def test_projected_points_are_on_the_surface_with_inward_normals(part: ConvexPart) -> None:
    points = random_points(part, 500, 3)
    feet, normals = part.project(points, part.nearest_facet(points))
    assert np.abs(part.depth(feet)).max() < 1e-12
    np.testing.assert_allclose(norm(normals), 1, atol=1e-12)
    # a half-space of a convex body: the whole surface lies on the inner side of every tangent plane
    surface = part.triangles()[0].reshape(-1, 3)
    assert ((surface[None] - feet[:, None]) * normals[:, None]).sum(axis=2).min() > -1e-12


@every_part
def test_points_outside_are_projected_to_the_nearest_surface_point(part: ConvexPart) -> None:
    points = random_points(part, 300, 4)
    points = points[part.depth(points) < 0]
    facets = np.unique(part.triangles()[1])
    projections = [part.project(points, np.full(len(points), facet))[0] for facet in facets]
    distances = np.min([norm(feet - points) for feet in projections], axis=0)
    surface = part.triangles()[0].mean(axis=1)
    assert (norm(points[:, None] - surface).min(axis=1) >= distances - 1e-9).all()
    # moving a nearest point of a convex body half-way towards the point must leave the body at once
    nearest = np.array(projections)[np.argmin([norm(f - points) for f in projections], axis=0), np.arange(len(points))]
    assert (np.abs(part.depth(nearest)) < 1e-12).all()
    assert (part.depth(nearest + 1e-6 * (points - nearest)) < 0).all()


@every_part
def test_surface_points_belong_to_their_own_facet(part: ConvexPart) -> None:
    triangles, facets = part.triangles()
    middles, _ = part.project(triangles.mean(axis=1), facets)
    assert (part.nearest_facet(middles) == facets).all()


@every_part
def test_triangles_have_corners_on_the_surface_and_face_outward(part: ConvexPart) -> None:
    triangles, facets = part.triangles()
    assert np.abs(part.depth(triangles.reshape(-1, 3))).max() < 1e-12
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    _, normals = part.project(triangles.mean(axis=1), facets)
    assert ((across * normals).sum(axis=1) < -0.9 * norm(across)).all()


@pytest.mark.parametrize("name", AREAS)
def test_triangles_cover_the_surface(name: str) -> None:
    triangles = PARTS[name].triangles()[0]
    area = norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])).sum() / 2
    flat = name in ("polyhedron", "box")
    assert area == pytest.approx(AREAS[name], rel=1e-12 if flat else 0.02)


@every_part
def test_bounds_are_the_tightest_box(part: ConvexPart) -> None:
    for axis in range(3):
        for bound, sign in zip(part.bounds()[:, axis], (-1.0, 1.0), strict=True):
            far = part.bounds().mean(axis=0) + sign * 1e6 * np.eye(3)[axis]
            facets = np.unique(part.triangles()[1])
            reach = [sign * part.project(far[None], np.array([facet]))[0][0, axis] for facet in facets]
            assert max(reach) == pytest.approx(sign * bound, abs=1e-7)


def test_cylinder_facets_are_side_top_and_bottom() -> None:
    cylinder = PARTS["cylinder"]
    points = TILTED.to_body(np.array([[0.0, 0.0, 0.21], [0.0, 0.0, -0.19], [0.0, 0.11, 0.1]]))
    assert cylinder.nearest_facet(points).tolist() == [TOP, BOTTOM, 0]


@every_part
def test_even_the_middle_has_a_projection(part: ConvexPart) -> None:
    middle = part.bounds().mean(axis=0)[None]
    feet, normals = part.project(middle, part.nearest_facet(middle))
    assert np.abs(part.depth(feet)).max() < 1e-12
    assert np.isfinite(normals).all()
