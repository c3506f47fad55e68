"""Groups of candidates: split to the end they are all subsets, once each; what is said of a row holds for them all."""

from itertools import chain, combinations, product
from math import comb, dist, prod

import numpy as np
import pytest

from planner.arrays import Indices
from planner.verification.groups import Groups, group_candidates

COUNTS = (7, 6)
FINGERS = (2, 1)


@pytest.fixture
def groups() -> Groups:
    """Two kinds in the plane, each with candidates that coincide, those first and last."""
    generator = np.random.default_rng(0)
    points = generator.normal(size=(13, 2))
    points[[1, 2]], points[[10, 11, 12]] = points[0], points[9]
    normals = np.tile([0.0, 1.0], (13, 1))
    return group_candidates(points, normals, COUNTS, generator.uniform(size=(13, 5)))


def members(groups: Groups) -> list[list[int]]:
    """The candidates of every group, by its halves."""
    found: list[list[int]] = [[] for _ in groups.half]
    for number in reversed(range(len(found))):
        half = int(groups.half[number])
        found[number] = [int(groups.first[number])] if half < 0 else found[half] + found[half + 1]
    return found


def subsets_of(row: Indices, groups: Groups) -> set[tuple[int, ...]]:
    """Every subset that a row stands for."""
    inside, numbers = members(groups), row.tolist()
    choices = [combinations(inside[group], numbers.count(group)) for group in dict.fromkeys(numbers)]
    return {tuple(sorted(chain(*parts))) for parts in product(*choices)}


def test_split_to_the_end_they_are_every_subset_once(groups: Groups) -> None:
    rows = np.repeat([0, 1], FINGERS)[None]
    single: list[tuple[int, ...]] = []
    for _ in range(50):
        done = (groups.size[rows] == 1).all(axis=1)
        single += [tuple(sorted(row)) for row in groups.first[rows[done]].tolist()]
        if done.all():
            break
        rows = groups.split(rows[~done])
    ends = product(combinations(range(7), 2), combinations(range(7, 13), 1))
    assert sorted(single) == sorted((*first, *second) for first, second in ends)
    assert len(single) == prod(map(comb, COUNTS, FINGERS))


def test_a_row_is_as_many_subsets_as_its_children(groups: Groups) -> None:
    row = np.array([[0, 0, 1]])
    for _ in range(6):
        children = groups.split(row)
        assert groups.subsets(children).sum() == pytest.approx(groups.subsets(row)[0])
        for child in children:
            assert groups.subsets(child[None])[0] == pytest.approx(len(subsets_of(child, groups)))
        row = children[groups.subsets(children).argmax()][None]


def test_the_bound_of_a_row_and_its_distances_hold_for_each_of_its_subsets(groups: Groups) -> None:
    rows = np.repeat([0, 1], FINGERS)[None]
    for _ in range(4):
        rows = np.concatenate([groups.split(rows[:1]), rows[1:]])
    table = {int(groups.first[k]): groups.largest[k] for k in np.flatnonzero(groups.size == 1)}
    points = {int(groups.first[k]): groups.lower[k] for k in np.flatnonzero(groups.size == 1)}
    for row, bound in zip(rows, groups.least_sums(rows), strict=True):
        for subset in subsets_of(row, groups):
            assert min(sum(table[i] for i in subset)) <= bound + 1e-12
            lengths = [dist(points[i], points[j]) for i, j in combinations(subset, 2)]
            assert groups.possible(row[None], min(lengths), max(lengths))[0]
