"""Parts that coincide or share a face are one surface, for the planner and for the simulator alike."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.candidates import Candidates
from planner.candidates.choice import make_candidates
from planner.candidates.confirmed import confirmed_candidates
from planner.contacts import Contacts
from planner.errors import CandidateError
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from sim.scene.static_check import StaticCheck
from sim.trial.experiment import set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.protocol import ACTIVE
from tests.strategies.assemblies import KINDS, random_assembly
from tests.tools.commands import run
from tests.tools.lanes import first_fast

ASSEMBLIES = 20
"""Of each kind."""

CANDIDATES = 6
"""Of each assembly."""

ONE = '<geom type="box" size=".03 .02 .01" mass=".2" friction=".5"/>'
TWIN = '<geom type="box" size=".03 .02 .01" mass="0" friction="{friction}"/>'


def written(folder: Path, *geoms: str) -> Path:
    path = folder / f"{len(geoms)}.xml"
    path.write_text(f"<mujoco><worldbody><body name='thing'><freejoint/>{''.join(geoms)}</body></worldbody></mujoco>")
    return path


def simulated(thing: RigidObject, contacts: Contacts) -> StaticCheck:
    """What the simulator says of fingertips there, before anything moves."""
    grasp = LoadedGrasp(
        rigid_object=thing,
        contacts=contacts,
        reference_point=thing.center_of_mass,
        wrenches=np.eye(6)[:1],
        phi=np.ones(1),
    )
    return set_up(grasp, ACTIVE).static


@pytest.mark.parametrize("kind", first_fast(range(len(KINDS))), ids=[kind.__name__.strip("_") for kind in KINDS])
def test_whatever_the_planner_confirms_the_simulator_accepts(kind: int, tmp_path: Path) -> None:
    confirmed = 0
    for round_ in range(ASSEMBLIES):
        path = random_assembly(tmp_path, kind + round_ * len(KINDS))
        thing = read_object(path)
        candidates = make_candidates(thing, str(CANDIDATES), friction=0.5, seed=round_)
        try:
            kept = confirmed_candidates(thing, candidates).candidates
        except CandidateError:
            continue  # every candidate is beside a wall
        assert simulated(thing, kept.contacts).reasons() == (), path.read_text()
        confirmed += len(kept)
    assert confirmed > ASSEMBLIES * CANDIDATES / 2


def candidates_of(path: Path) -> tuple[RigidObject, Candidates]:
    thing = read_object(path)
    return thing, confirmed_candidates(thing, make_candidates(thing, "100")).candidates


@pytest.mark.slow
def test_twins_are_planned_on_and_held_as_one_geom(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    alone, twins = written(tmp_path, ONE), written(tmp_path, ONE, TWIN.format(friction=0.5))
    (_, once), (_, twice) = candidates_of(alone), candidates_of(twins)
    assert (once.contacts.points == twice.contacts.points).all()
    assert len(once) == len(twice) == 100
    rho = []
    for path in (alone, twins):
        out = path.with_suffix(".json")
        assert run("grasp-plan", path, "--task", "gravity", "--candidates", "100", "--out", out) == 0
        rho.append(next(line for line in capsys.readouterr().out.splitlines() if line.startswith("rho")))
    assert rho[0] == rho[1]
    assert run("grasp-validate", out) == 0
    assert "verdict     PASS" in capsys.readouterr().out


def test_inspect_says_what_it_merged_and_whose_friction_counts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("grasp-inspect", written(tmp_path, ONE, TWIN.format(friction=0.2))) == 0
    said = capsys.readouterr().out
    assert "merged      geoms geom0 and geom1 coincide: planned on as one, with the smaller friction, 0.2" in said
    assert run("grasp-inspect", written(tmp_path, ONE)) == 0
    assert "merged" not in capsys.readouterr().out


@pytest.mark.parametrize("friction", [0.2, 0.9])
def test_the_smaller_friction_of_twins_counts(friction: float, tmp_path: Path) -> None:
    _, candidates = candidates_of(written(tmp_path, ONE, TWIN.format(friction=friction)))
    assert (candidates.contacts.friction == min(friction, 0.5)).all()


def test_beside_a_wall_both_refuse(tmp_path: Path) -> None:
    wall = '<geom type="box" size=".005 .02 .02" pos=".035 0 .01" mass=".1"/>'  # rises at x = 30 mm
    thing = read_object(written(tmp_path, ONE, wall))
    at_wall = thing.size * 1e-4
    for x, clear in ((0.03 - at_wall, False), (0.0, True)):
        contacts = Contacts(points=np.array([[x, 0, 0.01]]), normals=np.array([[0, 0, -1.0]]), friction=np.array([0.5]))
        candidates = Candidates(contacts=contacts, part=np.zeros(1, dtype=int), facet=np.zeros(1, dtype=int))
        if clear:
            assert len(confirmed_candidates(thing, candidates).candidates) == 1
        else:
            with pytest.raises(CandidateError, match="1 touch another part"):
                confirmed_candidates(thing, candidates)
        assert (simulated(thing, contacts).reasons() == ()) is clear


def test_a_wrong_normal_is_refused_by_both(tmp_path: Path) -> None:
    thing, candidates = candidates_of(written(tmp_path, ONE, TWIN.format(friction=0.5)))
    contacts = candidates.contacts.subset(np.array([0]))
    turned = contacts.normals + 0.01 * np.roll(contacts.normals, 1, axis=1)
    wrong = replace(contacts, normals=turned / np.linalg.norm(turned))
    asked = replace(candidates, contacts=wrong, part=candidates.part[:1], facet=candidates.facet[:1])
    with pytest.raises(CandidateError, match="1 have another normal"):
        confirmed_candidates(thing, asked)
    assert simulated(thing, wrong).reasons() and not simulated(thing, contacts).reasons()


@pytest.mark.parametrize("aside", [0.0, 1e-7, 1e-5, 1e-3])
def test_on_the_seam_of_a_face_that_two_boxes_share_a_finger_touches_one_surface(
    aside: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, ONE, '<geom type="box" size=".02 .02 .01" pos=".04 0 0" mass=".1"/>')  # overlap by 10 mm
    thing = read_object(path)
    point = np.array([[0.03 + aside, 0, 0.01]])  # about where the first box ends, inside the second
    contacts = Contacts(points=point, normals=np.array([[0, 0, -1.0]]), friction=np.array([0.5]))
    candidates = Candidates(contacts=contacts, part=np.ones(1, dtype=int), facet=np.zeros(1, dtype=int))
    assert len(confirmed_candidates(thing, candidates).candidates) == 1
    assert simulated(thing, contacts).reasons() == ()
    assert run("grasp-inspect", path) == 0
    assert "merged      faces of geom0 and geom1 coincide: planned on as one surface" in capsys.readouterr().out
