"""Opposed pairs: in each other's friction cones, on the outside, through walls but not seams, good for two fingers."""

import hashlib
import logging
from pathlib import Path

import numpy as np
import pytest

from planner.arrays import Floats
from planner.candidates.antipodal import antipodal_candidates
from planner.candidates.candidates import Candidates
from planner.candidates.choice import make_candidates
from planner.candidates.even import even_candidates
from planner.errors import CandidateError
from planner.grasp_problem import GraspProblem, GraspRequest, pose_problem
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.sphere import Sphere
from planner.objects.planar.reader import read_planar
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.task import make_task
from tests.strategies.cups import HALF, WALL, box_cup
from tests.strategies.parts import NAME, TILTED, box, rigid_object, tilted_parts
from tests.tools.commands import ASSETS

EVERYTHING = rigid_object(*tilted_parts().values())
SPIKE = 0.2 * np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
"""Corners of a tetrahedron, no two of whose faces are nearly parallel [m]."""


def angles(candidates: Candidates) -> Floats:
    """Of each contact's inward normal to the way to the other of its pair, shape (n,) [rad]."""
    points, normals = candidates.contacts.points, candidates.contacts.normals
    way = points.reshape(-1, 2, 3)[:, ::-1].reshape(-1, 3) - points
    cosines = np.einsum("id,id->i", way, normals) / np.linalg.norm(way, axis=1)
    return np.arccos(np.clip(cosines, -1, 1))


def widths(candidates: Candidates) -> Floats:
    """Distance of the two of each pair, shape (n / 2,) [m]."""
    first, second = candidates.contacts.points.reshape(-1, 2, 3).transpose(1, 0, 2)
    return np.linalg.norm(first - second, axis=1)


def spiked() -> RigidObject:
    """A tetrahedron with a small cube on a corner: nothing but two pairs of the cube's faces is opposed."""
    spike = Polyhedron.hull(SPIKE, geom="spike", friction=0.1)
    return rigid_object(spike, box((0.01, 0.01, 0.01), (0.2, 0.2, 0.2)))


@pytest.mark.parametrize("friction", [0.1, 0.5, 1.5, None])
def test_two_of_a_pair_lie_in_each_others_friction_cones_on_the_outside(friction: float | None) -> None:
    candidates = antipodal_candidates(EVERYTHING, 200, friction, seed=0)
    assert len(candidates) == 200
    assert (angles(candidates) < np.arctan(candidates.contacts.friction)).all()
    assert (candidates.contacts.friction == (friction or 0.7)).all()
    depths = np.array([part.depth(candidates.contacts.points) for part in EVERYTHING.parts])
    assert depths.max() < 1e-9
    assert np.abs(depths[candidates.part, np.arange(200)]).max() < 1e-12


def test_opposite_faces_and_the_far_side_of_a_ball_are_met_exactly() -> None:
    slab = antipodal_candidates(rigid_object(box((0.1, 0.2, 0.3))), 60, None, seed=0)
    assert angles(slab).max() < 1e-7
    assert set(np.round(widths(slab), 9)) == {0.2, 0.4, 0.6}
    ball = antipodal_candidates(
        rigid_object(Sphere(pose=TILTED, radius=0.2, geom=NAME, friction=0.1)), 60, None, seed=0
    )
    np.testing.assert_allclose(widths(ball), 0.4, rtol=1e-9)


def test_a_cup_is_pinched_at_its_wall_and_across_but_never_pushed_apart(tmp_path: Path) -> None:
    cup = read_object(box_cup(tmp_path))
    candidates = antipodal_candidates(cup, 200, 0.5, seed=0)
    found = set(np.round(widths(candidates), 6))
    assert found == {WALL, 2 * HALF}, "and neither the hollow nor from one outer face to the far inner one"
    assert (angles(candidates) < 1e-7).all()


def test_parts_that_are_glued_are_one_body() -> None:
    glued = rigid_object(box((0.1, 0.1, 0.1), (0, 0, -0.1)), box((0.1, 0.1, 0.1), (0, 0, 0.1)))
    candidates = antipodal_candidates(glued, 100, None, seed=0)
    assert set(np.round(widths(candidates), 9)) == {0.2, 0.4}
    assert (np.abs(candidates.contacts.points[:, 2]) > 1e-9).all()


def test_no_finger_is_put_into_a_slot_it_does_not_fit() -> None:
    plates = rigid_object(*(box((0.1, 0.1, 0.01), (0, 0, height)) for height in (-0.02, 0.02)))
    slender, thick = (
        widths(antipodal_candidates(plates, 200, None, seed=0, fingertip=radius)) for radius in (0.005, 0.015)
    )
    assert 0.02 in np.round(slender, 9), "one plate"
    assert 0.02 not in np.round(thick, 9)
    assert 0.06 in np.round(thick, 9), "both"


def test_points_are_apart_and_nearer_each_other_where_the_line_passes_the_centre_of_mass() -> None:
    slab = rigid_object(box((0.3, 0.3, 0.02)))
    first = antipodal_candidates(slab, 400, 0.4, seed=0).contacts.points[::2]
    across = first[np.abs(np.abs(first[:, 2]) - 0.02) < 1e-9, :2]
    nearest = np.sort(np.linalg.norm(across[:, None] - across, axis=2), axis=1)[:, 1]
    middle = np.linalg.norm(across, axis=1) < 0.1
    assert nearest.min() > 1e-3
    assert 1.5 * np.median(nearest[middle]) < np.median(nearest[~middle])
    assert np.abs(across).max() > 0.25, "but the rim is not left out"


def test_the_seed_decides_and_the_platform_does_not() -> None:
    def digest(seed: int) -> str:
        candidates = antipodal_candidates(EVERYTHING, 100, None, seed)
        rounded = np.round(candidates.contacts.points * 1e9).astype(np.int64)
        return hashlib.sha256(rounded.astype("<i8").tobytes()).hexdigest()[:16]

    assert digest(0) == "7182f55aa24211d3"
    assert digest(1) != digest(0)


def test_fewer_pairs_than_asked_for_are_said(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        few = make_candidates(spiked(), "antipodal:300", 0.1)
    assert 0 < len(few) < 300
    assert (few.part == 1).all()
    assert f"{len(few) // 2} of the 150 opposed pairs" in caplog.text
    caplog.clear()
    assert len(make_candidates(rigid_object(box((1, 1, 1))), "antipodal:300", 0.1)) == 300
    assert not caplog.text


def test_an_object_that_two_fingers_cannot_hold_anywhere_is_refused() -> None:
    with pytest.raises(CandidateError, match=r"no two places oppose each other.*friction"):
        make_candidates(rigid_object(Polyhedron.hull(SPIKE, geom="spike", friction=0.1)), "antipodal:20")


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ("antipodal:0", "0 candidates were asked for"),
        ("antipodal:-4", "-4 candidates"),
        ("antipodal:1000002", "choose 1 to 1000000"),
        ("antipodal:301", "301 candidates in opposed pairs; choose an even number, 302 for example"),
        ("antipodal:", "'antipodal:' names no number of points; write antipodal:300"),
        ("antipodal:0.5", "'antipodal:0.5' names no number"),
        ("antipodal", "neither known nor a file; give .*antipodal:300"),
    ],
)
def test_other_numbers_are_refused(choice: str, message: str) -> None:
    with pytest.raises(CandidateError, match=message):
        make_candidates(EVERYTHING, choice)


def test_a_planar_object_has_edges_instead() -> None:
    with pytest.raises(CandidateError, match="opposed pairs are chosen on objects in space"):
        make_candidates(read_planar(ASSETS / "planar" / "convex.toml"), "antipodal:20")


@pytest.mark.parametrize(
    ("file", "fingers", "choice"),
    [("box/box.xml", 2, "antipodal:300"), ("box/box.xml", 3, "300"), ("planar/convex.toml", 2, "300")],
)
def test_two_fingers_in_space_are_offered_opposed_pairs(file: str, fingers: int, choice: str) -> None:
    asked = GraspRequest(source=ObjectSource(file=ASSETS / file), fingers=fingers)
    chosen = pose_problem(asked).candidates.choice
    assert chosen is not None
    assert chosen.candidates == choice


def test_sixty_hold_two_soft_fingers_better_than_two_hundred_evenly_spread() -> None:
    """On a bracket; three seeds, of which the medians are compared."""
    bracket = read_object(ASSETS / "bracket" / "bracket.xml")

    task = make_task("gravity", bracket)

    def rho(candidates: Candidates) -> float:
        return plan(GraspProblem(bracket, task, candidates.twisting(None, 0.004), fingers=2)).rho

    opposed = [rho(antipodal_candidates(bracket, 60, None, seed)) for seed in range(3)]
    even = [rho(even_candidates(bracket, 200, None, seed)) for seed in range(3)]
    assert np.median(opposed) < np.median(even)
