"""Each "add a ..." of the README, carried out on a toy: in the places it names, and in no others."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from pathlib import Path

import msgspec
import numpy as np
import pytest

from planner.arrays import Floats, Indices, Mask
from planner.candidates.candidates import CandidateChoice, Candidates, candidates_at
from planner.candidates.choice import WAYS, make_candidates
from planner.contact_models import models
from planner.contact_models.hard_finger import HardFinger
from planner.contacts import Contacts
from planner.exchange import formats
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.limits import limits_file
from planner.limits.limits import Limits
from planner.limits.restricted import RESTRICTIONS
from planner.objects.graspable import Graspable
from planner.objects.mjcf.reader import read_object
from planner.objects.mjcf.writer import write_mjcf
from planner.objects.parts.box import Box
from planner.objects.parts.primitives import PRIMITIVES
from planner.objects.parts.sphere import Sphere
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.search.constraints.every_grasp import EVERY_GRASP
from planner.search.evaluation import Evaluator
from planner.search.exhaustive import exhaustive_search
from planner.search.problem import SearchProblem
from planner.search.regions.region_tree import RegionTree
from planner.search.result import Progress, SearchResult, Status
from planner.task import make_task
from planner.verification.proof_check import with_checked_proof
from planner.verification.provenance.choice import check_choice
from planner.wrench_sets.by_name import KINDS
from sim.validation import validation
from sim.validation.control_experiment import ControlExperiment, ControlOutcome
from sim.validation.validation import validate
from tests.tools.commands import ASSETS, ROOT, run

README = (ROOT / "README.md").read_text()


@pytest.fixture(scope="module")
def problem() -> GraspProblem:
    """Three fingers on a box, 24 candidates."""
    box = read_object(ASSETS / "box" / "box.xml")
    return GraspProblem(box, make_task("axes6", box), make_candidates(box, "24", 0.6, seed=0), fingers=3)


@pytest.fixture(scope="module")
def grasp(problem: GraspProblem) -> Grasp:
    """The best of them."""
    return plan(problem)


def test_every_recipe_of_the_readme_is_carried_out_here() -> None:
    nouns = [
        line.split("**")[1].removeprefix("Add a").lstrip("n ") for line in README.splitlines() if "**Add a" in line
    ]
    carried_out = {name for name in globals() if name.startswith("test_add_")}
    assert {f"test_add_{noun.split(' of ')[0].replace(' ', '_')}" for noun in nouns} == carried_out


class Pair(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { w, -w }."""

    wrench: tuple[float, ...]

    def vertices(self) -> Floats:
        return np.array([self.wrench, self.wrench]) * [[1.0], [-1.0]]

    def support(self, directions: Floats) -> Floats:
        return np.abs(directions @ np.array(self.wrench))


def test_add_wrench_set(problem: GraspProblem, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "pair", Pair)
    (tmp_path / "pair.toml").write_text('name = "pair"\n[set]\nkind = "pair"\nwrench = [0, 0, 2, 0, 0, 0]\n')
    task = make_task(str(tmp_path / "pair.toml"), problem.rigid_object)
    np.testing.assert_array_equal(task.wrenches[:, 2], [2, -2])
    assert plan(GraspProblem(problem.rigid_object, task, problem.candidates, fingers=3)).found


class Pearl(Sphere):
    """A sphere that remembers it is a pearl."""


def test_add_shape(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(PRIMITIVES, "sphere", Pearl)
    body = '<body name="pearl"><freejoint/><geom type="sphere" size="0.03" mass="0.1" friction="0.7"/></body>'
    (tmp_path / "pearl.xml").write_text(f"<mujoco><worldbody>{body}</worldbody></mujoco>")
    pearl = read_object(tmp_path / "pearl.xml")
    write_mjcf(tmp_path / "written.xml", pearl, np.zeros((0, 3, 3)))
    assert [type(part) for part in (*pearl.parts, *read_object(tmp_path / "written.xml").parts)] == [Pearl, Pearl]
    task = make_task("axes6", pearl)
    held = plan(GraspProblem(pearl, task, make_candidates(pearl, "30", None, seed=0), fingers=3))
    assert validate(pearl, held).verdict == "pass"


def face_points(rigid_object: RigidObject, _: CandidateChoice) -> Candidates:
    """One point on the diagonal of each face of a box."""
    part = rigid_object.parts[0]
    assert isinstance(part, Box)
    facets = np.arange(len(part.polygons))
    points = np.array([part.vertices[corners][:3].mean(axis=0) for corners in part.polygons])
    return candidates_at(rigid_object, points, np.zeros(len(facets), dtype=int), facets, 0.6)


def test_add_way_to_choose_candidates(problem: GraspProblem, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(WAYS, "faces", face_points)
    chosen = make_candidates(problem.rigid_object, "faces")
    assert len(chosen) == 6
    planned = plan(GraspProblem(problem.rigid_object, problem.task, chosen, fingers=3))
    assert check_choice(planned, problem.rigid_object).holds
    few = plan(GraspProblem(problem.rigid_object, problem.task, chosen.kept(np.arange(5)), fingers=3))
    assert check_choice(few, problem.rigid_object).fails, "one of them is missing"


class Lower(Limits, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Limits with one more: no contact above a height."""

    ceiling: float = np.inf


def below_ceiling(_: Graspable, candidates: Candidates, limits: Limits) -> Mask:
    return np.asarray(candidates.contacts.points[:, 2] <= getattr(limits, "ceiling", np.inf))


def test_add_limit(problem: GraspProblem, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(RESTRICTIONS, "ceiling", below_ceiling)
    monkeypatch.setattr(limits_file, "Limits", Lower)
    (tmp_path / "limits.toml").write_text("ceiling = 0.0\n")
    limits = limits_file.read_limits(tmp_path / "limits.toml", problem.rigid_object)
    lower = GraspProblem(problem.rigid_object, problem.task, problem.candidates, fingers=3, limits=limits)
    assert lower.allowed.removed["ceiling"] == (problem.candidates.contacts.points[:, 2] > 0).sum() > 0
    assert plan(lower).contacts.points[:, 2].max() <= 0


class Leaning:
    """The coordinates x of the contacts sum to at most `most`; see `Constraint`."""

    def __init__(self, most: float, problem: SearchProblem, tree: RegionTree) -> None:
        self.most, self.x = most, problem.contacts.points[:, 0]
        self.lower = tree.boxes(self.x[:, None])[0][:, 0]

    def possible(self, rows: Indices) -> Mask:
        return np.asarray(self.lower[rows].sum(axis=1) <= self.most)

    def admits(self, subsets: Indices) -> Mask:
        return np.asarray(self.x[subsets].sum(axis=1) <= self.most)

    def stated(self) -> dict[str, float]:
        return {}


def test_add_constraint(problem: GraspProblem, monkeypatch: pytest.MonkeyPatch) -> None:
    few = problem.search_problem.among(np.arange(14))
    free, x, evaluator = CertifiedSearch().run(few), few.contacts.points[:, 0], Evaluator(few)
    assert free.incumbent is not None
    most = float(x[free.incumbent.subset].sum()) - 1e-6
    subsets = np.array(list(combinations(range(14), 3)))
    best = min(evaluator.evaluate(subset).rho for subset in subsets[x[subsets].sum(axis=1) <= most])
    monkeypatch.setattr("planner.search.constraints.every_grasp.EVERY_GRASP", [*EVERY_GRASP, partial(Leaning, most)])
    found = CertifiedSearch().run(few)
    assert found.rho == pytest.approx(best, rel=1e-3)
    assert found.lower_bound > free.rho * 1.001
    proven, _ = with_checked_proof(found, lambda: False)
    assert proven.lower_bound <= free.rho, "what no certificate states must not be called proven"


class Weak(HardFinger):
    """A finger that pushes with half of what it is asked for."""

    def maps(self, contacts: Contacts, reference_point: Floats) -> Floats:
        return super().maps(contacts, reference_point) / 2

    def forces(self, contacts: Contacts, components: Floats) -> Floats:
        return super().forces(contacts, components) / 2


def test_add_contact_model(problem: GraspProblem, monkeypatch: pytest.MonkeyPatch) -> None:
    few = problem.search_problem.among(np.arange(12))
    strong = exhaustive_search(few)
    assert strong is not None
    weak = Weak()
    monkeypatch.setattr(models, "HARD_FINGER", weak)  # as `model_of` answers once it is told which contacts are weak
    again = problem.search_problem.among(np.arange(12))
    found = CertifiedSearch().run(again)
    assert found.status is Status.OPTIMAL
    assert found.rho == pytest.approx(2 * strong.rho, rel=1e-3)


def test_add_export(grasp: Grasp, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def write_fingertips(path: Path, rigid_object: Graspable, written: Grasp, wrench: int | None) -> None:
        path.write_text(f"{len(written.contacts.points)} points on {len(rigid_object.parts)} parts")

    from planner.grasps.grasp_file import write_grasp

    write_grasp(tmp_path / "box.grasp.json", grasp)
    assert run("grasp-convert", tmp_path / "box.grasp.json", "--out", tmp_path / "box.points") == 1
    monkeypatch.setattr(
        formats, "FORMATS", (*formats.FORMATS, formats.Format(ending=".points", fingertips=write_fingertips))
    )
    assert run("grasp-convert", tmp_path / "box.grasp.json", "--out", tmp_path / "box.points") == 0
    assert (tmp_path / "box.points").read_text() == "3 points on 1 parts"


@pytest.mark.parametrize("behaves", [True, False])
def test_add_control_experiment(
    behaves: bool, problem: GraspProblem, grasp: Grasp, monkeypatch: pytest.MonkeyPatch
) -> None:
    def wishful_control(*_: object) -> ControlExperiment:
        outcome = ControlOutcome(wrench=0, phi=1.0, cap=1.0, slip=1.0, held=behaves, expected=True, counted=True)
        return ControlExperiment(name="wishful", change="nothing at all", outcomes=(outcome,))

    assert isinstance(problem.rigid_object, RigidObject)
    monkeypatch.setattr(validation, "displacement_control", wishful_control)  # a call in validation.py
    result = validate(problem.rigid_object, grasp)
    assert result.controls[-1].name == "wishful"
    assert (result.verdict == "pass") is behaves


@dataclass(frozen=True, kw_only=True)
class FirstThatHolds(CertifiedSearch):
    """Takes the first subset that resists the task, and proves nothing."""

    def run(
        self,
        problem: SearchProblem,
        observe: Callable[[Progress], None] = lambda _: None,
        stop: Callable[[], bool] = lambda: False,
    ) -> SearchResult:
        evaluator, count = Evaluator(problem), len(problem.contacts)
        subsets = (np.array([i, j, k]) for i in range(count) for j in range(i) for k in range(j))
        first = next(each for each in map(evaluator.evaluate, subsets) if np.isfinite(each.rho))
        end = Progress(seconds=0, nodes=1, open=0, lower_bound=0, incumbent=first.rho, socp_solves=1, cuts=0)
        return SearchResult(
            problem=problem,
            method="first",
            status=Status.HEURISTIC,
            grasps=(first,),
            lower_bound=0.0,
            cuts=np.empty((0, problem.wrenches.shape[1])),
            trace=(end,),
        )


def test_add_search(problem: GraspProblem, grasp: Grasp) -> None:
    found = plan(problem, FirstThatHolds())
    assert (found.search.method, found.status) == ("first", Status.HEURISTIC)
    assert np.isfinite(found.rho) and found.rho >= grasp.rho
