"""The user's word decides which candidates are made."""

from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.contacts import MOST_FRICTION
from planner.errors import CandidateError
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.sphere import Sphere
from planner.objects.rigid_object import RigidObject
from tests.strategies.parts import NAME, PRISM_CORNERS, TILTED, box, rigid_object


def prism(friction: float = 0.3) -> RigidObject:
    # MuJoCo keeps mesh vertices in single precision
    corners = (0.01 * PRISM_CORNERS).astype(np.float32).astype(float)
    return rigid_object(Polyhedron.hull(corners, geom=NAME, friction=friction))


def test_the_papers_candidates_are_on_the_papers_prism() -> None:
    candidates = make_candidates(prism(), "case3", None, seed=0)
    assert len(candidates) == 217
    assert sorted(np.bincount(candidates.facet).tolist()) == [36, 36, 45, 45, 55]
    printed = 0.01 * np.array([[2 / 9, -4 / 3, 0], [2 / 3, 2 / 3, 0], [-4 / 3, 2 / 9, 0]])
    distances = np.linalg.norm(candidates.contacts.points[:, None] - printed, axis=2).min(axis=0)
    assert distances.max() < 1e-9
    into = -candidates.contacts.points[[int(i) for i in np.linspace(0, 216, 20)]]
    assert ((candidates.contacts.normals[[int(i) for i in np.linspace(0, 216, 20)]] * into).sum(axis=1) > 0).all()


def test_every_form_of_the_word_is_understood(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("-0.0133333333333333,0,0\n")
    assert len(make_candidates(prism(), "30", None, seed=0)) == 30
    assert len(make_candidates(prism(), "grid:0.01", None, seed=0)) > 10
    assert len(make_candidates(prism(), str(path), None, seed=0)) == 1


def test_friction_is_each_geoms_own_unless_given() -> None:
    ball = Sphere(geom="ball", friction=0.9, pose=TILTED, radius=1.0)
    thing = rigid_object(ball, box((1, 1, 1), (4, 0, 0)))
    own = make_candidates(thing, "40", None, seed=0)
    assert set(own.contacts.friction[own.part == 0]) == {0.9}
    assert set(own.contacts.friction[own.part == 1]) == {0.7}
    assert set(make_candidates(thing, "40", 0.25, seed=0).contacts.friction) == {0.25}


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ("0", "0 candidates"),
        ("-5", "-5 candidates"),
        ("9" * 30, "candidates were asked for"),
        ("9" * 5000, "neither known nor a file"),
        ("", "neither known nor a file"),
        ("3.5", "neither known nor a file"),
        ("none.csv", "'none.csv'.*300.*grid:0.004.*case3"),
        ("\0", "neither known nor a file"),
        ("grid", "neither known"),
        ("grid:", "spacing is ''"),
        ("grid:x", "spacing is 'x'"),
        ("grid:-1", "spacing is -1.0"),
        ("grid:nan", "spacing is nan"),
    ],
)
def test_other_words_are_refused(choice: str, message: str) -> None:
    with pytest.raises(CandidateError, match=message):
        make_candidates(prism(), choice, None, seed=0)


def test_the_papers_candidates_are_refused_on_another_object() -> None:
    with pytest.raises(CandidateError, match="point 1 of 217"):
        make_candidates(rigid_object(box((1, 1, 1))), "case3", None, seed=0)


def test_friction_beyond_what_solvers_can_plan_with_is_refused_whoever_states_it() -> None:
    assert len(make_candidates(prism(friction=MOST_FRICTION), "10", None, seed=0)) == 10
    with pytest.raises(CandidateError, match=rf"friction of geom '{NAME}' is 1e\+09; it must be positive and at most"):
        make_candidates(prism(friction=1e9), "10", None, seed=0)
    with pytest.raises(CandidateError, match=r"friction given is 1e\+09; it must be positive and at most 1000"):
        make_candidates(prism(), "10", 1e9, seed=0)


def test_a_geom_without_friction_needs_one_given() -> None:
    with pytest.raises(CandidateError, match=f"friction of geom '{NAME}' is 0; it must be positive and at most 1000"):
        make_candidates(prism(friction=0.0), "10", None, seed=0)
    assert len(make_candidates(prism(friction=0.0), "10", 0.4, seed=0)) == 10
