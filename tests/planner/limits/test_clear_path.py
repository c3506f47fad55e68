"""Distances along a straight path, against dense sampling."""

import math

import numpy as np
import pytest

from planner.limits.clear_path import keeps_clear, stays_above
from planner.limits.obstacles import Edge, HalfSpace, Obstacle, Solid
from tests.strategies.parts import tilted_parts
from tests.strategies.planar_objects import HOOK, planar_object
from tests.tools.lanes import first_fast

PARTS = tilted_parts()
SAMPLES = 50


@pytest.mark.parametrize("steepness", [0.0, 1e-6, 1.0, 1e6])
@pytest.mark.parametrize("lowest", [-0.5, 0.0, 1e-9, 0.3, 1.0, 2.0])
def test_a_convex_function_is_above_every_level_below_its_minimum_and_no_other(steepness: float, lowest: float) -> None:
    def hyperbola(t: float) -> tuple[float, float]:
        value = math.sqrt(1 + steepness * (t - lowest) ** 2)
        return value, steepness * (t - lowest) / value

    least = hyperbola(min(max(lowest, 0.0), 1.0))[0]
    assert stays_above(hyperbola, 1.0, least * (1 - 1e-9))
    assert not stays_above(hyperbola, 1.0, least * (1 + 1e-9))


def test_a_corner_of_a_convex_function_is_found() -> None:
    def kink(t: float) -> tuple[float, float]:
        return max(-t, 3 * t - 2), -1.0 if t < 0.5 else 3.0

    assert stays_above(kink, 1.0, -0.5 - 1e-12)
    assert not stays_above(kink, 1.0, -0.5 + 1e-12)


@pytest.mark.parametrize("shape", first_fast(PARTS))
def test_the_nearest_point_of_a_part_is_the_one_all_others_lie_behind(shape: str) -> None:
    """y of a convex set is nearest to x if and only if (x - y) . (z - y) <= 0 for every z of the set."""
    part = PARTS[shape]
    solid, others = Solid(part=part), part.triangles()[0].reshape(-1, 3)
    lower, upper = part.bounds()
    outside = 0
    for point in np.random.default_rng(1).uniform(lower - 0.2, upper + 0.2, (60, 3)):
        nearest = solid.nearest(point)
        outside += part.depth(point[None])[0] < 0
        assert abs(part.depth(nearest[None])[0]) < 1e-9 or (nearest == point).all()
        assert ((others - nearest) @ (point - nearest)).max() < 1e-9
    assert outside > 30


@pytest.mark.parametrize(
    "obstacle",
    [
        *(Solid(part=part) for part in PARTS.values()),
        HalfSpace(up=np.array([0.6, 0.0, 0.8]), height=0.1),
        *(Edge(outline=planar_object(HOOK).outline, number=number) for number in (0, 5)),
    ],
    ids=[*PARTS, "half_space", "edge", "another_edge"],
)
def test_a_path_is_clear_by_exactly_its_least_distance(obstacle: Obstacle) -> None:
    generator = np.random.default_rng(2)
    lower, upper = np.nan_to_num(obstacle.bounds(), posinf=1, neginf=-1)
    for start, end in generator.uniform(lower - 0.3, upper + 0.3, (20, 2, len(lower))):
        points = start + np.linspace(0, 1, SAMPLES)[:, None] * (end - start)
        least = min(float(np.linalg.norm(point - obstacle.nearest(point))) for point in points)
        spacing = float(np.linalg.norm(end - start)) / SAMPLES
        if least > spacing:
            assert keeps_clear(obstacle, start, end, least - spacing)
        assert not keeps_clear(obstacle, start, end, least + 1e-9)
