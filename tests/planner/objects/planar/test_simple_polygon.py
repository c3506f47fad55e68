"""Which lists of corners are one closed line that does not meet itself."""

import numpy as np
import pytest

from planner.errors import ObjectError
from planner.objects.planar.simple_polygon import MOST_CORNERS, signed_area, simple_polygon
from tests.strategies.planar_objects import HOOK, star

BOW_TIE = [(0, 0), (2, 2), (2, 0), (0, 3)]


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([], "0 corners; 3 to 500"),
        ([(0, 0), (1, 0)], "2 corners; 3 to 500"),
        ([(k, k * k) for k in range(MOST_CORNERS + 1)], "501 corners"),
        ([(0, 0), (1, 0), (0, np.nan)], r"corner 2 of 'x' is \[0.0, nan\]"),
        ([(0, 0), (np.inf, 0), (0, 1)], r"corner 1 of 'x' is \[inf, 0.0\]"),
        ([(0, 0), (2e6, 0), (0, 1)], "at most 1e\\+06 m"),
        ([(0, 0), (1, 0), (1, 1), (0, 0)], "corners 0 and 3 of 'x' are the same point"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], "corners 1 and 2 of 'x' are the same point"),
        ([(0, 0), (0, 0), (0, 0)], "the same point"),
        ([(0, 0), (1, 0), (2, 0)], "in line with its two neighbours"),
        ([(0, 0), (2, 0), (2, 1), (1, 0), (0, 1)], "edges 0 and 2 of 'x' meet"),  # a corner on a far edge
        ([(0, 0), (1, 0), (2, 0), (2, 1)], "corner 1 of 'x' is in line"),
        ([(0, 0), (3, 0), (1, 0), (1, 1)], "corner 1 of 'x' is in line"),  # there and back
        (BOW_TIE, "edges 0 and 2 of 'x' meet"),
        ([*HOOK[:3], (-1, 0.5), *HOOK[3:]], "meet"),
    ],
)
def test_other_lists_of_corners_are_refused(corners: list[tuple[float, float]], message: str) -> None:
    with pytest.raises(ObjectError, match=message):
        simple_polygon(np.array(corners, dtype=float).reshape(-1, 2), "x")


@pytest.mark.parametrize("seed", range(20))
def test_corners_in_either_sense_become_counter_clockwise_from_the_same_first(seed: int) -> None:
    corners = star(seed)
    np.testing.assert_array_equal(simple_polygon(corners, "x"), corners)
    clockwise = np.vstack([corners[:1], corners[:0:-1]])
    assert signed_area(clockwise) == pytest.approx(-signed_area(corners))
    np.testing.assert_array_equal(simple_polygon(clockwise, "x"), corners)


@pytest.mark.parametrize("seed", range(20))
def test_exchanging_two_corners_of_a_convex_polygon_makes_it_meet_itself(seed: int) -> None:
    generator = np.random.default_rng(seed)
    angles = np.sort(generator.choice(360, 8, replace=False)) * np.pi / 180
    corners = np.column_stack([3 * np.cos(angles), np.sin(angles)])
    simple_polygon(corners, "x")
    first, second = generator.choice(8, 2, replace=False)
    corners[[first, second]] = corners[[second, first]]
    with pytest.raises(ObjectError, match="meet"):
        simple_polygon(corners, "x")


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e5])
@pytest.mark.parametrize("seed", range(3))
def test_size_and_place_do_not_matter(scale: float, seed: int) -> None:
    simple_polygon(scale * (star(seed) + 7), "x")
