"""Even candidates: exact in number, on the outside, well spread, the same everywhere."""

import hashlib

import numpy as np
import pytest
from scipy.spatial import cKDTree

from planner.candidates.even import even_candidates
from planner.errors import CandidateError
from tests.strategies.parts import box, rigid_object, tilted_parts

PARTS = tilted_parts()
EVERYTHING = rigid_object(*PARTS.values())


@pytest.mark.parametrize("count", [1, 2, 57, 1000])
def test_the_count_is_exact(count: int) -> None:
    assert len(even_candidates(EVERYTHING, count, None, seed=0)) == count


def test_candidates_lie_on_the_outer_surface_of_their_own_part() -> None:
    candidates = even_candidates(EVERYTHING, 500, None, seed=0)
    depths = np.array([part.depth(candidates.contacts.points) for part in EVERYTHING.parts])
    assert depths.max() < 1e-9
    own = depths[candidates.part, np.arange(500)]
    assert np.abs(own).max() < 1e-12
    for index, part in enumerate(EVERYTHING.parts):
        here = candidates.part == index
        facets = candidates.facet[here]
        _, normals = part.project(candidates.contacts.points[here], facets)
        np.testing.assert_allclose(candidates.contacts.normals[here], normals, atol=1e-12)
    assert (candidates.contacts.friction == 0.7).all()


def test_no_region_is_crowded_or_empty() -> None:
    cube = rigid_object(box((1, 1, 1)))
    points = even_candidates(cube, 600, 0.5, seed=0).contacts.points
    spacing = np.sqrt(24 / 600)
    assert cKDTree(points).query(points, 2)[0][:, 1].min() > 0.7 * spacing
    everywhere = even_candidates(cube, 5000, 0.5, seed=9).contacts.points
    assert cKDTree(points).query(everywhere)[0].max() < 1.1 * spacing


def test_the_seed_decides_and_the_platform_does_not() -> None:
    def digest(seed: int) -> str:
        candidates = even_candidates(EVERYTHING, 200, None, seed)
        rounded = np.round(candidates.contacts.points * 1e9).astype(np.int64)
        return hashlib.sha256(rounded.astype("<i8").tobytes()).hexdigest()[:16]

    # parts 0 and 4 lie inside others: this digest is of points that are not drawn on them nor kept clear of them
    assert digest(0) == "05236b46d26a1de5"
    assert digest(1) != digest(0)


@pytest.mark.parametrize(
    ("count", "friction", "seed", "message"),
    [
        (0, None, 0, "0 candidates"),
        (-3, None, 0, "-3 candidates"),
        (1_000_001, None, 0, "choose 1 to 1000000"),
        (5, 0.0, 0, "friction given is 0; it must be positive and at most 1000"),
        (5, -1.0, 0, "friction given is -1; "),
        (5, 1e9, 0, r"friction given is 1e\+09; it must be positive and at most 1000"),
        (5, np.inf, 0, "friction given is inf"),
        (5, np.nan, 0, "friction given is nan"),
        (5, None, -1, "seed is -1"),
    ],
)
def test_arguments_out_of_range_are_refused(count: int, friction: float | None, seed: int, message: str) -> None:
    with pytest.raises(CandidateError, match=message):
        even_candidates(EVERYTHING, count, friction, seed)


def test_coplanar_faces_of_overlapping_parts_are_kept() -> None:
    twins = rigid_object(box((1, 1, 1)), box((1, 1, 1)))
    assert len(even_candidates(twins, 10, None, seed=0)) == 10


def test_a_part_cased_in_others_gets_no_candidates() -> None:
    case = [box(tuple(3 - 2 * axis), tuple(2.0 * side * axis)) for axis in np.eye(3) for side in (-1, 1)]
    cased = rigid_object(box((1, 1, 1)), *case)
    assert (even_candidates(cased, 50, None, seed=0).part > 0).all()


def test_a_surface_nearly_all_hidden_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planner.candidates.even.reachable", lambda *arguments: np.zeros(len(arguments[1]), dtype=bool))
    with pytest.raises(CandidateError, match="only 0 of 4000 random surface points"):
        even_candidates(EVERYTHING, 10, None, seed=0)
