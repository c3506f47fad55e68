"""Soft fingers from the object to the file: what `plan(problem)` says stays when all is turned, scaled or written."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from planner.arrays import Floats
from planner.candidates.choice import make_candidates
from planner.candidates.listed import listed_candidates
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import read_grasp, write_grasp
from planner.objects.mjcf.reader import read_object
from planner.planning import plan, plan_several
from planner.search.certified import CertifiedSearch
from planner.search.result import Status
from planner.task import Task, make_task
from planner.verification.verify import verify
from tests.strategies.filed_plans import document_of, preset_plan
from tests.strategies.side_files import archived, arrays_of, write_with_side_file
from tests.tools.commands import ASSETS, run

BOX = ASSETS / "box" / "box.xml"

TOOL = """<mujoco><worldbody><body name="tool"><freejoint/><body pos="{position}" quat="{turn}">
<geom name="grip" type="box" size="{grip}" mass="0.1" friction="0.5"/>
<geom name="head" type="box" size="{head}" pos="0 0 {high}" quat="0.9 0.2 -0.3 0.1" mass="0.2" friction="0.8"/>
</body></body></worldbody></mujoco>"""

POINTS = np.array(
    [
        (0.01, 0.0, 0.002),
        (-0.01, 0.001, 0.0),
        (0.0, 0.012, 0.01),
        (0.002, -0.012, 0.008),
        (0.01, 0.003, -0.03),
        (-0.01, -0.004, -0.028),
        (0.004, 0.012, -0.02),
        (-0.003, -0.012, -0.022),
    ]
)
"""On the grip of the tool, in the frame of its geoms [m]."""


class Placed:
    """The tool, its lengths scaled, then turned and moved in the frame of its body."""

    def __init__(self, folder: Path, scale: float, turn: Rotation, position: Floats) -> None:
        self.scale, self.turn, self.position = scale, turn, position
        x, y, z, w = turn.as_quat().tolist()
        lengths: dict[str, list[float]] = {
            "position": position.tolist(),
            "turn": [w, x, y, z],
            "grip": [scale * half for half in (0.01, 0.012, 0.04)],
            "head": [scale * half for half in (0.02, 0.01, 0.008)],
            "high": [scale * 0.055],
        }
        written = {name: " ".join(map(repr, numbers)) for name, numbers in lengths.items()}
        file = folder / "tool.xml"
        file.write_text(TOOL.format(**written))
        self.body = read_object(file)

    def planned(self, force: float, fingers: int, torsion: float) -> Grasp:
        """With 2 mm of torsion where the scale is one, for loads that grow with it: `force` times as large.

        Args:
            force: Factor of all loads; moments grow with the scale beside.
            fingers: How many.
            torsion: Torsional friction [m].
        """
        points = self.turn.apply(self.scale * POINTS) + self.position
        forces = np.vstack([np.eye(3), -np.eye(3), [[0.3, -2, 0.5]]])
        moments = self.scale * np.cross([0.01, -0.02, 0.03], forces)
        task = Task(
            name="pull",
            reference_point=self.turn.apply(self.scale * np.array([0, 0, 0.02])) + self.position,
            wrenches=force * np.hstack([self.turn.apply(forces), self.turn.apply(moments)]),
        )
        candidates = listed_candidates(self.body, points, 0.5).twisting(torsion, None)
        return plan(GraspProblem(self.body, task, candidates, fingers), CertifiedSearch(gap=1e-6))


@pytest.mark.parametrize("fingers", [2, 3])
@settings(max_examples=15, deadline=None)
@given(
    scale=st.floats(0.1, 10),
    force=st.floats(0.01, 100),
    position=st.tuples(*3 * [st.floats(-1, 1)]),
    turn=st.tuples(*4 * [st.floats(-1, 1)]).filter(lambda quaternion: np.linalg.norm(quaternion) > 0.1),
)
def test_object_and_loads_turned_and_scaled_together_change_nothing(
    fingers: int,
    scale: float,
    force: float,
    position: tuple[float, ...],
    turn: tuple[float, ...],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """rho grows as the loads do, and with nothing else; torsion that does not grow with the lengths is another one."""
    folder = tmp_path_factory.mktemp("tool")
    before = Placed(folder, 1.0, Rotation.identity(), np.zeros(3)).planned(1.0, fingers, 0.002)
    other = Placed(folder, scale, Rotation.from_quat(turn), np.array(position))
    after = other.planned(force, fingers, 0.002 * scale)
    assert before.status is after.status is Status.OPTIMAL
    assert after.rho == pytest.approx(force * before.rho, rel=1e-5)
    assert after.lower_bound == pytest.approx(force * before.lower_bound, rel=1e-5)
    np.testing.assert_allclose(np.sort(after.phi), force * np.sort(before.phi), rtol=1e-2)
    if fingers == 2 and not 0.8 < scale < 1.25:
        assert other.planned(force, fingers, 0.002).rho != pytest.approx(force * before.rho, rel=1e-2)


def test_rho_of_an_uncertain_friction_is_that_of_the_worst_friction_and_torsion() -> None:
    """With mu and gamma anywhere between 0.8 and 1.2 of what is said; at the command, patches and torsion alike."""
    box = read_object(BOX)
    task, asked = make_task("gravity", box), make_candidates(box, "60", 0.5)
    uncertain = plan(GraspProblem(box, task, asked.twisting(0.002, None).least_friction(0.2), 2))
    worst = {}
    for mu in (0.8, 1.0, 1.2):
        for gamma in (0.8, 1.0, 1.2):
            candidates = make_candidates(box, "60", 0.5 * mu).twisting(0.002 * gamma, None)
            worst[mu, gamma] = plan(GraspProblem(box, task, candidates, 2)).rho
    assert uncertain.rho == pytest.approx(max(worst.values()), rel=2e-3) == pytest.approx(worst[0.8, 0.8], rel=2e-3)
    assert min(worst.values()) < 0.95 * uncertain.rho
    assert all(check.holds for check in verify(uncertain))


def test_a_patch_loses_its_friction_error_once(tmp_path: Path) -> None:
    out = tmp_path / "box.grasp.json"
    given = ["--fingers", 2, "--candidates", 40, "--friction-error", 0.2, "--out", out, "--quiet"]
    assert run("grasp-plan", BOX, *given, "--patch", 0.004) == 0
    assert read_grasp(out).contacts.torsions == pytest.approx(2 / 3 * 0.8 * 0.5 * 0.004)
    assert run("grasp-verify", out) == 0


def test_a_soft_grasp_survives_its_file(tmp_path: Path) -> None:
    box = read_object(BOX)
    candidates = make_candidates(box, "40", 0.5).twisting(None, 0.004)
    grasp = plan(GraspProblem(box, make_task("gravity", box), candidates, 2))
    write_grasp(tmp_path / "soft.grasp.json", grasp)
    read = read_grasp(tmp_path / "soft.grasp.json")
    for name in ("torques", "forces", "phi"):
        np.testing.assert_array_equal(getattr(read, name), getattr(grasp, name))
    assert grasp.torques.any()
    np.testing.assert_array_equal(read.contacts.torsions, grasp.contacts.torsions)
    np.testing.assert_array_equal(read.certificate.candidates.torsions, grasp.certificate.candidates.torsions)
    assert read.candidate_choice == grasp.candidate_choice
    document = document_of(tmp_path / "soft.grasp.json")
    assert document["format_version"] == 3
    assert {contact["torsion"] for contact in document["contacts"]} == set(grasp.contacts.torsions.tolist())


def test_grasp_files_of_before_torsional_friction_are_read_and_true(tmp_path: Path) -> None:
    """Version 2 says nothing of torsion or torques; version 1 has its candidates in a side file."""
    file = preset_plan(tmp_path)
    true = read_grasp(file)
    document = document_of(file)
    document["format_version"] = 2
    for key in ("torques", "candidate_choice/torsion", "candidate_choice/patch"):
        *folders, last = key.split("/")
        del (document[folders[0]] if folders else document)[last]
    assert "torsion" not in json.dumps(document)
    second = tmp_path / "second.grasp.json"
    second.write_text(json.dumps(document))
    write_with_side_file(tmp_path / "first.grasp.json", true, archived(arrays_of(true)))
    for old in (second, tmp_path / "first.grasp.json"):
        grasp = read_grasp(old)
        assert not grasp.contacts.torsions.any() and not grasp.torques.any()
        assert grasp.torques.shape == (len(grasp.phi), 3)
        assert not grasp.certificate.candidates.torsions.any()
        assert all(check.holds for check in verify(grasp))


def test_several_grasps_of_soft_fingers_are_written_and_each_is_true(tmp_path: Path) -> None:
    box = read_object(BOX)
    candidates = make_candidates(box, "40", 0.5).twisting(0.002, None)
    problem = GraspProblem(box, make_task("gravity", box), candidates, 2)
    for search in (CertifiedSearch(keep=3), CertifiedSearch(keep=3, apart=0.01)):
        grasps = plan_several(problem, search)
        assert len(grasps) == 3
        for number, grasp in enumerate(grasps):
            file = tmp_path / f"{number}.grasp.json"
            write_grasp(file, grasp)
            assert all(check.holds for check in verify(read_grasp(file)))


def test_the_summary_for_scripts_has_torsion_and_grip(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "box.grasp.json"
    given = ["--fingers", 2, "--candidates", 40, "--patch", 0.004, "--out", out, "--json", "--quiet"]
    assert run("grasp-plan", BOX, *given) == 0
    summary = json.loads(capsys.readouterr().out)
    assert [contact["torsion"] for contact in summary["contacts"]] == pytest.approx([2 / 3 * 0.5 * 0.004] * 2)
    grasp = read_grasp(out)
    assert summary["grip"] == pytest.approx(grasp.grip) and summary["grip"] < summary["rho"]
