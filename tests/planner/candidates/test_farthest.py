"""Blocks make farthest-point sampling faster, not different."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.candidates.farthest import farthest_points
from planner.objects.neighbour_blocks import neighbour_blocks


def plain_farthest_points(
    pool: Floats, count: int, partners: Floats | None = None, spacing: Floats | None = None
) -> list[int]:
    chosen = [0]
    for _ in range(count - 1):
        taken = pool[chosen] if partners is None else np.concatenate([pool[chosen], partners[chosen]])
        distances = np.linalg.norm(pool[:, None] - taken, axis=2).min(axis=1)
        chosen.append(int((distances if spacing is None else distances / spacing).argmax()))
    return chosen


@pytest.mark.parametrize(("size", "count"), [(1, 1), (5, 5), (130, 40), (777, 60), (1000, 60)])
def test_the_choice_equals_that_of_the_plain_algorithm(size: int, count: int) -> None:
    pool = np.random.default_rng(size).normal(size=(size, 3)) * [3, 1, 0.2]
    assert farthest_points(pool, count).tolist() == plain_farthest_points(pool, count)


@pytest.mark.parametrize(("size", "count"), [(1, 1), (5, 5), (130, 40), (777, 60), (1000, 60)])
def test_partners_and_uneven_spacing_are_those_of_the_plain_algorithm_too(size: int, count: int) -> None:
    generator = np.random.default_rng(size)
    pool, partners = generator.normal(size=(2, size, 3)) * [3, 1, 0.2]
    spacing = generator.uniform(0.1, 3, size)
    for given in ((partners, None), (None, spacing), (partners, spacing)):
        assert farthest_points(pool, count, *given).tolist() == plain_farthest_points(pool, count, *given)


def test_blocks_hold_every_point_and_are_compact() -> None:
    pool = np.random.default_rng(0).random((5000, 3))
    blocks = neighbour_blocks(pool)
    assert set(blocks.ravel()) == set(range(5000))
    assert len(blocks) >= 32
    assert np.ptp(pool[blocks], axis=1).mean() < 0.5
