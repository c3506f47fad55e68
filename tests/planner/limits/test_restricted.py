"""What every restriction removes, counted and planned with, against oracles that go point by point."""

from collections.abc import Callable
from itertools import product
from math import inf, sqrt

import numpy as np
import pytest

from planner.candidates.candidates import Candidates
from planner.candidates.choice import make_candidates
from planner.errors import CandidateError, LimitsError
from planner.grasp_problem import GraspProblem
from planner.limits.limits import Approach, Limits, Table, Zone
from planner.limits.restricted import restricted
from planner.limits.table import table_height
from planner.objects.mjcf.reader import read_object
from planner.objects.planar.reader import read_planar
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.search.exhaustive import exhaustive_search
from planner.search.problem import SearchProblem
from planner.task import make_task
from tests.strategies.parts import rigid_object, tilted_parts
from tests.tools.capsule import Capsule
from tests.tools.commands import ASSETS
from tests.tools.lanes import first_fast

PARTS = tilted_parts()
BRACKET = ASSETS / "bracket" / "bracket.xml"
RADIUS, LENGTH = 0.012, 0.05
SLANTED = (-0.6, 0.0, 0.8)


@pytest.fixture(scope="module")
def bracket() -> RigidObject:
    return read_object(BRACKET)


@pytest.fixture(scope="module")
def candidates(bracket: RigidObject) -> Candidates:
    return make_candidates(bracket, "26", None, seed=2)


def is_off_the_upright(bracket: RigidObject, candidates: Candidates, index: int) -> bool:
    return bracket.parts[candidates.part[index]].geom == "base"


def is_out_of_the_boxes(bracket: RigidObject, candidates: Candidates, index: int) -> bool:
    x, _, z = candidates.contacts.points[index]
    return not (x >= 0.02 or 0.05 <= z <= 0.06)


def is_high_above_the_slanted_table(bracket: RigidObject, candidates: Candidates, index: int) -> bool:
    corners = [-0.6 * x + 0.8 * z for x, z in product((-0.04, 0.04), (-0.004, 0.004))]
    corners += [-0.6 * x + 0.8 * z for x, z in product((-0.039, -0.031), (0.0, 0.06))]
    x, _, z = candidates.contacts.points[index]
    return -0.6 * x + 0.8 * z - min(corners) >= 0.02


def is_reached_in_mujoco(bracket: RigidObject, candidates: Candidates, index: int) -> bool:
    point, normal = candidates.contacts.points[index], candidates.contacts.normals[index]
    way = point - RADIUS * normal, point - (RADIUS + LENGTH) * normal
    return Capsule(BRACKET, bracket, RADIUS, LENGTH).least_distance(*way, candidates.part[index]) > -1e-3 * RADIUS


CASES: dict[str, tuple[Limits, Callable[[RigidObject, Candidates, int], bool]]] = {
    "exclude_geoms": (Limits(exclude_geoms=("up*",)), is_off_the_upright),
    "keep_out": (
        Limits(
            keep_out=(
                Zone(lower=(0.02, -inf, -inf), upper=(inf, inf, inf)),
                Zone(lower=(-1, -1, 0.05), upper=(1, 1, 0.06)),
            )
        ),
        is_out_of_the_boxes,
    ),
    "table": (Limits(table=Table(normal=SLANTED, clearance=0.02)), is_high_above_the_slanted_table),
    "approach": (Limits(approach=Approach(radius=RADIUS, length=LENGTH)), is_reached_in_mujoco),
}


@pytest.mark.parametrize("name", first_fast(CASES, fast=2))
def test_planning_with_a_restriction_is_enumerating_what_it_allows(
    name: str, bracket: RigidObject, candidates: Candidates
) -> None:
    limits, is_allowed = CASES[name]
    allowed = [index for index in range(len(candidates)) if is_allowed(bracket, candidates, index)]
    assert 3 < len(allowed) < len(candidates)
    task = make_task("axes6", bracket)
    left = restricted(bracket, candidates, limits)
    assert left.removed == {**dict.fromkeys(CASES, 0), name: len(candidates) - len(allowed)}
    grasp = plan(GraspProblem(bracket, task, left.candidates, 3))
    problem = SearchProblem(
        contacts=candidates.contacts.subset(np.array(allowed)),
        fingers=3,
        reference_point=task.reference_point,
        wrenches=task.wrenches,
    )
    best = exhaustive_search(problem)
    assert grasp.found == (best is not None)
    assert best is None or best.rho * (1 - 1e-7) <= grasp.rho <= best.rho * (1 + 1.1e-3)


def test_each_candidate_counts_for_the_first_restriction_that_forbids_it(
    bracket: RigidObject, candidates: Candidates
) -> None:
    pairs = [CASES[name] for name in CASES]
    geoms, boxes, table = (limits for limits, _ in pairs[:3])
    together = Limits(exclude_geoms=geoms.exclude_geoms, keep_out=boxes.keep_out, table=table.table)
    rules = [is_allowed for _, is_allowed in pairs[:3]]
    first = [
        next((number for number, rule in enumerate(rules) if not rule(bracket, candidates, index)), None)
        for index in range(len(candidates))
    ]
    left = restricted(bracket, candidates, together)
    assert list(left.removed.values()) == [first.count(0), first.count(1), first.count(2), 0]
    kept = np.array([index for index, number in enumerate(first) if number is None])
    np.testing.assert_array_equal(left.candidates.contacts.points, candidates.contacts.points[kept])
    np.testing.assert_array_equal(left.candidates.part, candidates.part[kept])


def test_no_limits_leave_every_candidate(bracket: RigidObject, candidates: Candidates) -> None:
    left = restricted(bracket, candidates, Limits())
    assert not any(left.removed.values())
    np.testing.assert_array_equal(left.candidates.contacts.points, candidates.contacts.points)


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        (
            Limits(exclude_geoms=("*",)),
            r"exclude_geoms leaves none of the 26 candidates \(removed: 26 by exclude_geoms",
        ),
        (Limits(keep_out=(Zone(lower=(-1, -1, -1), upper=(1, 1, 1)),)), "keep_out leaves none"),
        (Limits(table=Table(normal=(0, 0, 1), clearance=1)), "table leaves none .* loosen the limits"),
        (
            Limits(
                exclude_geoms=("upright",),  # it can always be reached from above
                table=Table(normal=(0, 0, 1), clearance=1e-3),
                approach=Approach(radius=0.5, length=1),
            ),
            r"approach leaves none of the 26 .*removed: \d+ by exclude_geoms, \d+ by table, \d+ by approach",
        ),
    ],
)
def test_a_restriction_that_leaves_nothing_is_named(
    limits: Limits, message: str, bracket: RigidObject, candidates: Candidates
) -> None:
    with pytest.raises(CandidateError, match=message):
        restricted(bracket, candidates, limits)


def test_limits_of_another_object_are_refused(bracket: RigidObject, candidates: Candidates) -> None:
    with pytest.raises(LimitsError, match="no geom 'handle'; it has base, upright"):
        restricted(bracket, candidates, Limits(exclude_geoms=("handle",)))


@pytest.mark.parametrize("shape", PARTS)
def test_an_object_stands_on_its_lowest_point(shape: str) -> None:
    thing = rigid_object(PARTS[shape])
    lower, upper = PARTS[shape].bounds()
    for axis in range(3):
        up = tuple(np.eye(3)[axis])
        down = tuple(-np.eye(3)[axis])
        assert table_height(thing, Table(normal=up, clearance=1)) == pytest.approx(lower[axis], abs=1e-6 * thing.size)
        assert table_height(thing, Table(normal=down, clearance=1)) == pytest.approx(
            -upper[axis], abs=1e-6 * thing.size
        )


def test_a_given_height_replaces_the_lowest_point(bracket: RigidObject, candidates: Candidates) -> None:
    left = restricted(bracket, candidates, Limits(table=Table(normal=(0, 0, 5), height=0.01, clearance=0.01)))
    assert left.candidates.contacts.points[:, 2].min() >= 0.02
    assert left.removed["table"] == (candidates.contacts.points[:, 2] < 0.02).sum()


def test_a_planar_object_is_restricted_by_the_same_limits() -> None:
    spanner = read_planar(ASSETS / "planar" / "concave.toml")
    candidates = make_candidates(spanner, "30", None, seed=0)
    limits = Limits(
        keep_out=(Zone(lower=(-inf, -inf), upper=(-0.06, inf)),), table=Table(normal=(0, 1 / sqrt(2)), clearance=0.005)
    )
    points = candidates.contacts.points
    allowed = [
        index for index, (x, y) in enumerate(points) if x > -0.06 and y >= -0.03 + 0.005
    ]  # it stands on its head
    task = make_task("axes6", spanner)
    grasp = plan(GraspProblem(spanner, task, restricted(spanner, candidates, limits).candidates, 3))
    problem = SearchProblem(
        contacts=candidates.contacts.subset(np.array(allowed)),
        fingers=3,
        reference_point=task.reference_point,
        wrenches=task.wrenches,
    )
    best = exhaustive_search(problem)
    assert best is not None
    assert grasp.rho == pytest.approx(best.rho, rel=1.1e-3)
