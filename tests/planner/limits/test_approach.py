"""The fingertip's way to a contact, against MuJoCo's collisions, dense sampling, and by hand."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import KDTree

from planner.arrays import Floats
from planner.candidates.candidates import candidates_at
from planner.candidates.choice import make_candidates
from planner.candidates.listed import listed_candidates
from planner.limits.approach import approachable
from planner.limits.limits import Approach, Limits, Table
from planner.objects.mjcf.reader import read_object
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.surface.exposure import SEAM
from tests.strategies.cups import box_cup
from tests.strategies.mjcf_files import EVERY_SHAPE, shared_object, written
from tests.strategies.overlapping_parts import OVERLAPPING
from tests.strategies.parts import box, rigid_object
from tests.strategies.planar_objects import HOOK, planar_object, star
from tests.tools.capsule import Capsule
from tests.tools.commands import ASSETS
from tests.tools.lanes import first_fast


def agrees_with_mujoco(path: Path, radius: float, length: float, candidates: int) -> None:
    """Every verdict that is not within 1e-3 of a radius of the opposite is MuJoCo's, and both verdicts occur."""
    thing = read_object(path)
    chosen = make_candidates(thing, str(candidates), 0.5, seed=4)
    allowed = approachable(thing, chosen, Limits(approach=Approach(radius=radius, length=length)))
    capsule = Capsule(path, thing, radius, length)
    contacts = chosen.contacts
    starts = contacts.points - radius * contacts.normals
    ends = starts - length * contacts.normals
    ways = zip(starts, ends, chosen.part, strict=True)
    margins = np.array([capsule.least_distance(start, end, own) for start, end, own in ways]) + SEAM * radius
    sure = np.abs(margins) > 0.5 * SEAM * radius
    assert sure.mean() > 0.95
    np.testing.assert_array_equal(allowed[sure], margins[sure] > 0)
    assert min(allowed.sum(), (~allowed).sum()) > 0.05 * candidates


@pytest.mark.parametrize(
    ("text", "radius", "length"), [(EVERY_SHAPE, 0.04, 0.5), (OVERLAPPING, 0.02, 0.05)], ids=["every_shape", "overlap"]
)
def test_every_kind_of_geom_is_passed_as_mujoco_collides_it(
    tmp_path: Path, text: str, radius: float, length: float
) -> None:
    agrees_with_mujoco(written(tmp_path, text), radius, length, 200)


@pytest.mark.parametrize("name", ["mug", "bracket"])
def test_the_assets_are_approached_as_mujoco_collides_them(name: str) -> None:
    agrees_with_mujoco(ASSETS / name / f"{name}.xml", 0.012, 0.06, 200)


def test_a_shared_mug_of_hulls_is_approached_as_mujoco_collides_it() -> None:
    agrees_with_mujoco(shared_object("ycb_mug/objects/ycb/025_mug.xml"), 0.008, 0.06, 80)


def test_a_cup_is_reached_inside_only_by_a_finger_that_fits(tmp_path: Path) -> None:
    cup = read_object(box_cup(tmp_path))  # 64 mm wide inside, open at the top
    inside = listed_candidates(cup, np.array([[0.032, 0.0, 0.0], [0.0, 0.0, -0.032]]), None)
    for radius, length, wall, bottom in (
        (0.01, 0.04, True, True),
        (0.01, 0.05, False, True),  # 2 r + l is more than 64 mm
        (0.031, 0.001, True, True),
        (0.033, 0.2, False, False),
    ):
        limits = Limits(approach=Approach(radius=radius, length=length))
        assert approachable(cup, inside, limits).tolist() == [wall, bottom], radius


def test_the_whole_of_a_wall_of_plates_is_approached_from_outside() -> None:
    """A rule by the planes of facets alone would give up the wall beside every edge."""
    mug = read_object(ASSETS / "mug" / "mug.xml")
    candidates = make_candidates(mug, "1500", None, seed=0)
    points, normals = candidates.contacts.points, candidates.contacts.normals
    outer = ((points * normals)[:, :2].sum(axis=1) < -0.0399) & (points[:, 0] < 0) & (normals[:, 2] == 0)
    chosen = candidates.subset(np.flatnonzero(outer))
    assert len(chosen) > 300
    assert approachable(mug, chosen, Limits(approach=Approach(radius=0.02, length=0.1))).all()


def on_boundary(thing: PlanarObject, spacing: float) -> Floats:
    """Points of the outline, at most `spacing` apart."""
    outline = thing.outline
    steps = np.linspace(0, 1, int(outline.lengths.max() / spacing) + 2)[:, None]
    return np.concatenate([a + steps * e for a, e in zip(outline.corners, outline.edges, strict=True)])


@pytest.mark.parametrize("corners", first_fast([HOOK, *(star(seed).tolist() for seed in range(2))]))
@pytest.mark.parametrize("table", [None, Table(normal=(1.0, 2.0), height=-0.2, clearance=0.1)])
def test_a_planar_way_is_free_as_far_as_discs_along_it_touch_nothing(
    corners: list[tuple[float, float]], table: Table | None
) -> None:
    thing, radius, length = planar_object(corners), 0.15, 0.6
    candidates = make_candidates(thing, "70", None, seed=0)
    allowed = approachable(thing, candidates, Limits(approach=Approach(radius=radius, length=length), table=table))
    spacing = radius / 100
    boundary = KDTree(on_boundary(thing, spacing))
    for point, normal, verdict in zip(candidates.contacts.points, candidates.contacts.normals, allowed, strict=True):
        centers = point - (radius + np.linspace(0, length, int(length / spacing))[:, None]) * normal
        distances = boundary.query(centers)[0]
        distances[thing.outline.depth(centers) > 0] = 0
        if table is not None:
            distances = np.minimum(distances, centers @ np.array([1, 2]) / np.sqrt(5) + 0.2)
        if abs(distances.min() - radius) > 2 * spacing:
            assert verdict == (distances.min() > radius)
        elif verdict:
            assert distances.min() > (1 - SEAM) * radius - 1e-9
    assert 0 < allowed.sum() < len(candidates)


def test_the_way_stays_above_the_table() -> None:
    brick = rigid_object(box((0.1, 0.1, 0.1), (0, 0, 0.1)))
    sides = listed_candidates(brick, np.array([[0.1, 0, 0.049], [0.1, 0, 0.051], [0, 0, 0.2]]), None)
    limits = Limits(approach=Approach(radius=0.05, length=0.1), table=Table(normal=(0, 0, 1), clearance=1e-3))
    assert approachable(brick, sides, limits).tolist() == [False, True, True]
    assert approachable(brick, sides, Limits(approach=limits.approach)).all()


def test_a_plate_thinner_than_the_fingertip_hides_what_it_is_glued_on() -> None:
    plate = rigid_object(box((1, 1, 1)), box((0.5, 0.5, 0.01), (0, 0, 1.01)))
    top = np.array([[x, 0.0, 1.0] for x in (0.0, 0.45, 0.559, 0.561)])
    facet, part = plate.parts[0].nearest_facet(top), np.zeros(len(top), dtype=int)
    candidates = candidates_at(plate, top, part, facet, None)
    limits = Limits(approach=Approach(radius=0.1, length=5))
    assert approachable(plate, candidates, limits).tolist() == [False, False, False, True]  # 0.56: 0.06, 0.08, 0.1
