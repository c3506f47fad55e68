"""Lines through triangles: as the depth of convex parts says, and in blocks as all against all."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.objects.parts.hull import MERGE_TOLERANCE
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.surface.rays import crossings, ray_hits
from tests.strategies.parts import NAME


def rays(count: int) -> tuple[Floats, Floats]:
    """From outside the unit ball towards its inside, and some past it."""
    generator = np.random.default_rng(count)
    origins = generator.normal(size=(count, 3))
    origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = generator.uniform(-0.8, 0.8, size=(count, 3)) - origins
    return origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)


def lumpy(corners: int) -> Polyhedron:
    """A polyhedron with all its corners on the unit ball."""
    points = np.random.default_rng(corners).normal(size=(corners, 3))
    return Polyhedron.hull(points / np.linalg.norm(points, axis=1, keepdims=True), geom=NAME, friction=0.5)


@pytest.mark.parametrize("corners", [8, 100, 2000])
def test_a_line_enters_a_convex_part_once_and_leaves_it_once(corners: int) -> None:
    part, (origins, directions) = lumpy(corners), rays(50)
    ray, _, distance = crossings(part.triangles()[0], origins, directions)
    along = np.linspace(0, 6, 801)
    samples = origins[:, None] + along[:, None] * directions[:, None]
    inside = part.depth(samples.reshape(-1, 3)).reshape(50, -1) > 0
    for number in range(50):
        met = np.unique(distance[ray == number].round(9))
        if inside[number].any():
            assert len(met) == 2
            np.testing.assert_allclose(met, along[inside[number]][[0, -1]], atol=2 * along[1])
        places = origins[number] + met[:, None] * directions[number]
        assert np.abs(part.depth(places)).max(initial=0) < 4 * MERGE_TOLERANCE, "facets may be bent by that"


def test_blocks_lose_no_crossing_and_make_none_up() -> None:
    triangles, (origins, directions) = lumpy(3000).triangles()[0], rays(150)
    hits = ray_hits(triangles, origins[:, None], directions[:, None])
    expected = {(ray, triangle) for ray, triangle in np.argwhere((hits > 0) & np.isfinite(hits)).tolist()}
    ray, triangle, distance = crossings(triangles, origins, directions)
    assert set(zip(ray.tolist(), triangle.tolist(), strict=True)) == expected
    np.testing.assert_array_equal(distance, hits[ray, triangle])
    assert len(expected) > 200


def test_what_lies_behind_or_beside_is_not_met() -> None:
    triangles, (origins, directions) = lumpy(50).triangles()[0], rays(20)
    for nothing in (crossings(triangles, origins, -directions), crossings(triangles, origins + 9, directions)):
        assert [len(each) for each in nothing] == [0, 0, 0]
