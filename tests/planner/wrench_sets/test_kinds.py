"""Every kind of required external force set against its definition."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.errors import TaskError
from planner.wrench_sets.ball import WrenchBall
from planner.wrench_sets.box import WrenchBox
from planner.wrench_sets.by_name import KINDS
from planner.wrench_sets.cylinder import WrenchCylinder
from planner.wrench_sets.ellipsoid import WrenchEllipsoid
from planner.wrench_sets.polytope import WrenchPolytope
from planner.wrench_sets.single import SingleWrench
from planner.wrench_sets.wrench_set import WrenchSet

TURN = np.asarray(Rotation.from_rotvec([0.3, -0.5, 0.8]).as_matrix())
TURN_ROWS = tuple(map(tuple, TURN.tolist()))
CORNERS = ((1.0, 0.0, 2.0), (-1.0, 0.5, 0.0), (0.2, 0.1, 0.0), (1.0, 0.0, 2.0))


def length(vector: Floats) -> float:
    return float(np.sqrt((vector * vector).sum()))


def turned(w: Floats) -> Floats:
    """The wrench in the axes of the turned ellipsoid."""
    return np.concatenate([TURN.T @ w[:3], TURN.T @ w[3:]])


# Each set, and by how much a wrench violates its definition (not positive: a member).
SETS: dict[str, tuple[WrenchSet, Callable[[Floats], float]]] = {
    "box in space": (
        WrenchBox(force=(1, 2, 3), moment=(0.1, 0.2, 0.3), center=(0, 0, -9, 0, 1, 0)),
        lambda w: float((np.abs(w - [0, 0, -9, 0, 1, 0]) - [1, 2, 3, 0.1, 0.2, 0.3]).max()),
    ),
    "flat box in the plane": (WrenchBox(force=(1, 0), moment=(2,)), lambda w: float((np.abs(w) - [1, 0, 2]).max())),
    "ball in space": (
        WrenchBall(radius=2, length=0.1, facets=84),
        lambda w: np.hypot(length(w[:3]), length(w[3:]) / 0.1) - 2,
    ),
    "ball in the plane": (
        WrenchBall(radius=2, length=0.1, dimension=2),
        lambda w: np.hypot(length(w[:2]), length(w[2:]) / 0.1) - 2,
    ),
    "turned ellipsoid": (
        WrenchEllipsoid(force=(1, 2, 3), moment=(0.1, 0.4, 0.2), rotation=TURN_ROWS),
        lambda w: length(turned(w) / [1, 2, 3, 0.1, 0.4, 0.2]) - 1,
    ),
    "flat ellipsoid off the origin": (
        WrenchEllipsoid(force=(1, 0), moment=(0.5,), center=(0, 3, 0)),
        lambda w: max(np.hypot(w[0], w[2] / 0.5) - 1, abs(w[1] - 3)),
    ),
    "cylinder in space": (WrenchCylinder(force=5, moment=0.1), lambda w: max(length(w[:3]) - 5, length(w[3:]) - 0.1)),
    "cylinder in the plane": (
        WrenchCylinder(force=5, moment=2, dimension=2),
        lambda w: max(length(w[:2]) - 5, abs(w[2]) - 2),
    ),
    "forces only": (WrenchCylinder(force=5, moment=0), lambda w: max(length(w[:3]) - 5, length(w[3:]))),
    "single": (SingleWrench(wrench=(0, 0, -5, 0, 0, 0.1)), lambda w: length(w - [0, 0, -5, 0, 0, 0.1])),
}
EVERY_SET = {name: wrench_set for name, (wrench_set, _) in SETS.items()} | {
    "polytope": WrenchPolytope(wrenches=CORNERS)
}


def random_directions(dimension: int, count: int) -> Floats:
    return np.random.default_rng(7).normal(size=(count, dimension))


@pytest.mark.parametrize("wrench_set", EVERY_SET.values(), ids=EVERY_SET)
def test_the_polytope_contains_the_set(wrench_set: WrenchSet) -> None:
    vertices = wrench_set.vertices()
    directions = random_directions(vertices.shape[1], 2000)
    reach = (directions @ vertices.T).max(axis=1)
    assert (reach >= wrench_set.support(directions) - 1e-9).all()


@pytest.mark.parametrize("wrench_set", EVERY_SET.values(), ids=EVERY_SET)
def test_no_vertex_is_repeated(wrench_set: WrenchSet) -> None:
    vertices = wrench_set.vertices()
    assert len(np.unique(np.round(vertices, 9), axis=0)) == len(vertices)


@pytest.mark.parametrize(("wrench_set", "violation"), SETS.values(), ids=SETS)
def test_the_support_function_is_attained_by_a_member(
    wrench_set: WrenchSet, violation: Callable[[Floats], float]
) -> None:
    """The gradient of a support function is the wrench that attains it."""
    dimension = wrench_set.vertices().shape[1]
    step = 1e-6
    for direction in random_directions(dimension, 50):
        ahead = wrench_set.support(direction + step * np.eye(dimension))
        behind = wrench_set.support(direction - step * np.eye(dimension))
        farthest = (ahead - behind) / (2 * step)
        assert violation(farthest) < 1e-6
        assert direction @ farthest == pytest.approx(float(wrench_set.support(direction[None])[0]), abs=1e-6)


@pytest.mark.parametrize(("wrench_set", "violation"), SETS.values(), ids=SETS)
def test_no_member_reaches_beyond_the_support_function(
    wrench_set: WrenchSet, violation: Callable[[Floats], float]
) -> None:
    """Members: convex combinations of vertices, drawn towards the middle until the definition accepts them."""
    vertices = wrench_set.vertices()
    rng = np.random.default_rng(3)
    directions = random_directions(vertices.shape[1], 200)
    middle = vertices.mean(axis=0)
    for wrench in rng.dirichlet(np.full(len(vertices), 0.1), size=50) @ vertices:
        member = middle + (wrench - middle) * max(
            t for t in np.linspace(0, 1, 101) if fits(middle, wrench, t, violation)
        )
        assert (directions @ member <= wrench_set.support(directions) + 1e-9).all()


def fits(middle: Floats, wrench: Floats, share: float, violation: Callable[[Floats], float]) -> bool:
    return violation(middle + share * (wrench - middle)) <= 1e-12


@pytest.mark.parametrize("name", ["box in space", "flat box in the plane", "single", "polytope"])
def test_a_polytope_is_its_own_outer_approximation(name: str) -> None:
    vertices = EVERY_SET[name].vertices()
    directions = random_directions(vertices.shape[1], 100)
    np.testing.assert_allclose((directions @ vertices.T).max(axis=1), EVERY_SET[name].support(directions))


def test_the_planar_cylinder_is_the_papers_ten_sided_polyhedron() -> None:
    """8 sides with flats on the axes, 2 caps, 16 vertices."""
    vertices = WrenchCylinder(force=3, moment=2, dimension=2).vertices()
    sides = np.unique(np.round(ConvexHull(vertices).equations, 6) + 0.0, axis=0)
    assert (len(vertices), len(sides)) == (16, 10)
    np.testing.assert_allclose(vertices.max(axis=0), [3, 3, 2])


def test_a_box_has_a_corner_for_every_choice_of_signs() -> None:
    vertices = WrenchBox(force=(1, 1, 1), moment=(2, 2, 2)).vertices()
    assert len(vertices) == 64
    np.testing.assert_array_equal(np.abs(vertices), np.tile([1, 1, 1, 2, 2, 2], (64, 1)))
    assert len(WrenchBox(force=(1, 0, 0), moment=(0, 0, 2)).vertices()) == 4


def test_every_kind_has_a_set_under_test() -> None:
    assert {type(wrench_set) for wrench_set in EVERY_SET.values()} == set(KINDS.values())


NAN = float("nan")
SPACE: dict[str, Any] = {"force": (1, 1, 1), "moment": (1, 1, 1)}


@pytest.mark.parametrize(
    ("kind", "values", "message"),
    [
        ("box", {"force": (1, -1, 1), "moment": (1, 1, 1)}, "not be negative"),
        ("box", {"force": (1, NAN, 1), "moment": (1, 1, 1)}, r"force must be finite .* got \[1.0, nan, 1.0\]"),
        ("box", {"force": (1, 1, 1), "moment": (1, 1)}, r"moment has shape \(2,\); expected 3 numbers"),
        ("box", {"force": (1,), "moment": (1,)}, "expected 2 or 3 numbers"),
        ("box", {"force": (0, 0), "moment": (0,)}, "zero wrench alone"),
        ("box", {**SPACE, "center": (0, 0, 0)}, r"center has shape \(3,\); expected 6"),
        ("ball", {"radius": 0, "length": 1}, "radius must be finite and positive, .* got 0"),
        ("ball", {"radius": 1, "length": -1}, "length must be finite and positive, .* got -1"),
        ("ball", {"radius": 1, "length": 1, "dimension": 4}, r"2 \(plane\) or 3 \(space\), got 4"),
        ("cylinder", {"force": NAN, "moment": 1}, "force must be finite and not negative, .* got nan"),
        ("cylinder", {"force": 0, "moment": 0}, "zero wrench alone"),
        ("ellipsoid", {"force": (0, 0), "moment": (0,), "center": (1, 0, 0)}, "positive semi-axis"),
        ("ellipsoid", {**SPACE, "rotation": ((1, 0, 0), (0, 1, 0), (0, 0, -1))}, "determinant"),
        ("ellipsoid", {**SPACE, "rotation": ((1, 0, 0), (0, 1, 0), (0, 0, NAN))}, "orthonormal"),
        ("ellipsoid", {**SPACE, "rotation": ((1, 0), (0, 1))}, "3 rows of 3 numbers"),
        ("single", {"wrench": (0, 0, 0)}, "wrench is zero"),
        ("single", {"wrench": (1, 0)}, r"shape \(2,\); expected 3 or 6 numbers"),
        ("polytope", {"wrenches": ()}, "empty"),
        ("polytope", {"wrenches": ((0, 0, 0),)}, "all zero"),
        ("polytope", {"wrenches": ((1, 0, 0), (1, 0))}, r"wrenches\[1\] has shape \(2,\)"),
        ("polytope", {"wrenches": ((1, 0, float("inf")),)}, r"wrenches\[0\] must be finite"),
    ],
)
def test_malformed_values_are_refused_with_what_is_allowed(kind: str, values: dict[str, Any], message: str) -> None:
    with pytest.raises(TaskError, match=message):
        KINDS[kind](**values)


@pytest.mark.parametrize("facets", ["force_facets", "moment_facets"])
def test_zero_facets_are_refused_not_replaced(facets: str) -> None:
    cylinder = WrenchCylinder(force=1, moment=1, **{facets: 0})
    with pytest.raises(TaskError, match="got 0"):
        cylinder.vertices()
