"""Distance to the outer surface."""

import numpy as np
import pytest
from trimesh.triangles import closest_point

from planner.candidates.even import even_candidates
from planner.errors import ObjectError
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.surface.nearest import nearest_on_triangles, surface_distance
from tests.strategies.parts import FRICTION, NAME, PRISM_CORNERS, TILTED, box, rigid_object, tilted_parts
from tests.tools.lanes import first_fast

PARTS = tilted_parts()


def test_gamma_of_the_papers_prism_is_exact() -> None:
    prism = rigid_object(Polyhedron.hull(0.01 * PRISM_CORNERS, geom=NAME, friction=FRICTION))
    assert surface_distance(prism, np.zeros(3)) == pytest.approx(0.02 * np.sqrt(2) / 3, abs=1e-15)


@pytest.mark.parametrize(
    ("name", "local", "distance"),
    [
        ("sphere", (0.0, 0.0, 0.0), 0.2),
        ("sphere", (0.5, 0.0, 0.0), 0.3),
        ("ellipsoid", (0.0, 0.0, 0.0), 0.05),
        ("ellipsoid", (0.0, 0.3, 0.0), 0.2),
        ("cylinder", (0.0, 0.0, 0.0), 0.1),
        ("cylinder", (0.0, 0.0, 0.15), 0.05),
        ("cylinder", (0.4, 0.0, 0.6), 0.5),
        ("capsule", (0.03, 0.0, 0.0), 0.07),
        ("box", (0.0, 0.0, 0.0), 0.05),
        ("box", (0.4, 0.6, 0.05), 0.5),
        ("polyhedron", (0.0, 0.0, -0.04), 0.01),
    ],
)
def test_distance_to_a_single_part_is_exact(name: str, local: tuple[float, ...], distance: float) -> None:
    point = TILTED.to_body(np.array(local))
    assert surface_distance(rigid_object(PARTS[name]), point) == pytest.approx(distance, abs=1e-9)


def test_faces_inside_other_parts_do_not_count() -> None:
    bar = rigid_object(box((1.5, 1, 1), (-1, 0, 0)), box((1.5, 1, 1), (1, 0, 0)))
    assert surface_distance(bar, np.zeros(3)) == pytest.approx(1, abs=1e-12)
    assert surface_distance(bar, np.array([2.3, 0, 0])) == pytest.approx(0.2, abs=1e-12)


def test_the_nearest_point_may_lie_where_parts_intersect() -> None:
    corner = rigid_object(box((2, 0.5, 0.5)), box((0.5, 2, 0.5), (-1.5, 1.5, 0)))
    point = np.array([-1.3, 0.2, 0.45])  # below the reentrant edge x = -1, y = 0.5, and near the top
    assert surface_distance(corner, point) == pytest.approx(0.05, abs=1e-12)
    tall = rigid_object(box((2, 0.5, 5)), box((0.5, 2, 5), (-1.5, 1.5, 0)))
    distance = surface_distance(tall, point)
    assert np.hypot(0.3, 0.3) <= distance <= 1.002 * np.hypot(0.3, 0.3)


@pytest.mark.parametrize(
    "names", first_fast([["cylinder", "ellipsoid"], ["box", "capsule", "polyhedron"], ["sphere", "box"]])
)
def test_unions_agree_with_dense_sampling(names: list[str]) -> None:
    thing = rigid_object(*(PARTS[name] for name in names))
    samples = even_candidates(thing, 3000, 0.5, seed=1).contacts.points
    spacing = np.sort(np.linalg.norm(samples[:, None] - samples[None, ::10], axis=2), axis=0)[1].max()
    for point in TILTED.to_body(np.random.default_rng(2).uniform(-0.15, 0.15, (4, 3))):
        sampled = np.linalg.norm(samples - point, axis=1).min()
        assert sampled - spacing <= surface_distance(thing, point) <= sampled * 1.001


def test_nearest_points_of_triangles_are_not_improved_by_any_sample() -> None:
    generator = np.random.default_rng(3)
    triangles, point = generator.normal(size=(50, 3, 3)), generator.normal(size=3)
    weights = generator.dirichlet(np.ones(3) * 0.5, size=4000)
    samples = np.einsum("sk,tkd->tsd", weights, triangles)
    nearest = np.linalg.norm(nearest_on_triangles(triangles, point) - point, axis=1)
    sampled = np.linalg.norm(samples - point, axis=2).min(axis=1)
    assert (nearest <= sampled + 1e-12).all()
    assert (nearest >= sampled - 0.15).all()


def test_each_triangle_may_have_a_point_of_its_own() -> None:
    generator = np.random.default_rng(4)
    triangles, points = generator.normal(size=(200, 3, 3)), 2 * generator.normal(size=(200, 3))
    triangles[:20, 2] = triangles[:20, 1]  # segments, and points
    triangles[:5] = triangles[:5, :1]
    one_by_one = [nearest_on_triangles(triangles[i : i + 1], points[i])[0] for i in range(200)]
    assert np.array_equal(nearest_on_triangles(triangles, points), one_by_one)
    assert np.allclose(nearest_on_triangles(triangles, points), closest_point(triangles, points), atol=1e-9)


def test_a_point_that_is_not_finite_is_refused() -> None:
    with pytest.raises(ObjectError, match="not finite"):
        surface_distance(rigid_object(PARTS["sphere"]), np.array([0, np.nan, 0]))
