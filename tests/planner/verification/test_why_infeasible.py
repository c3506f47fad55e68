"""What is said about an infeasible task is true of its candidates, and what is said to help does help."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from planner.candidates.listed import listed_candidates
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.planning import plan
from planner.search.result import Status
from planner.task import Task
from planner.verification.why_infeasible import hopeless_cut, reasons, remedies
from sim.report.report_data import hopeless_wrench
from tests.strategies.parts import box, rigid_object
from tests.tools.commands import run, says

BRICK = rigid_object(box((0.05, 0.03, 0.08)))
DOWN = [0.0, 0, -78.4, 0, 0, 0]


def planned(points: Sequence[tuple[float, ...]], wrenches: Sequence[Sequence[float]], fingers: int = 2) -> Grasp:
    task = Task(name="load", reference_point=np.zeros(3), wrenches=np.array(wrenches, dtype=float))
    return plan(GraspProblem(BRICK, task, listed_candidates(BRICK, np.array(points, dtype=float), 0.5), fingers))


BESIDE = [(0.01, 0.03, 0.0), (0.02, -0.03, 0.0), (0.0, 0.03, 0.02), (0.03, -0.03, 0.01)]
OPPOSITE = [(0.0, 0.03, 0.0), (0.0, -0.03, 0.0)]


def test_pairs_beside_the_load_are_infeasible_and_opposite_ones_help_as_said() -> None:
    grasp = planned(BESIDE, [DOWN])
    assert grasp.status is Status.INFEASIBLE
    (reason,) = reasons(grasp)
    assert says(reason, "has one for every pair of these 4 candidates")
    assert "whichever" not in reason and "wherever" not in reason
    assert says(
        remedies(grasp)[0],
        r"opposite each other.*listed in a CSV file \(--candidates\); or fingertips that resist turning",
    )
    assert planned(BESIDE + OPPOSITE, [DOWN]).rho == pytest.approx(np.hypot(78.4, 39.2), rel=1e-6)


@pytest.mark.parametrize(("offset", "said"), [(4e-7, "0.0002"), (2e-3, "1")])
def test_how_far_the_nearest_line_misses_the_load_is_said(offset: float, said: str) -> None:
    """Points that a rounding has moved are told from points that are elsewhere."""
    grasp = planned([(offset, 0.03, 0.0), (0.0, -0.03, 0.0), (0.04, 0.03, 0.02)], [DOWN])
    assert grasp.status is Status.INFEASIBLE
    assert reasons(grasp)[0].endswith(f"; the nearest line misses the load by {said} mm")
    moments = planned(BESIDE, [[0, 0, 0, 0, 0, 1.0]])
    assert "misses" not in "".join(reasons(moments))


def test_a_task_with_moments_about_every_line_is_said_to_need_a_third_finger() -> None:
    turning = [[*row] for row in np.vstack([np.eye(6), -np.eye(6)]) * [1, 1, 1, 0.01, 0.01, 0.01]]
    grasp = planned(BESIDE + OPPOSITE, turning)
    assert grasp.status is Status.INFEASIBLE
    assert says(reasons(grasp)[0], "about every line there is: two never hold it, wherever they are")
    assert remedies(grasp)[0].startswith("fingertips that resist turning: --patch 0.004")
    assert says(remedies(grasp)[0], "or a third finger")
    flat = [row for row in turning if not row[5]]  # a load in five dimensions leaves lines
    assert says(remedies(planned(BESIDE, flat))[0], "opposite each other")


def test_a_direction_is_called_hopeless_only_if_no_candidate_can_push_along_it() -> None:
    top = [(x, y, 0.08) for x in (-0.04, 0.0, 0.04) for y in (-0.02, 0.02)]
    grasp = planned(top, [DOWN], fingers=3)
    cut = hopeless_cut(grasp)
    assert cut is not None and hopeless_wrench(grasp) == 0
    assert says(reasons(grasp)[0], r"direction \(.*\): no candidate can push the object along it")
    assert remedies(grasp) == ["more candidates: 6 are few for 3 fingers"]
    weak = replace(grasp.certificate, cuts=np.array([[0.0, 0, 1, 0, 0, 0], [1.0, 0, 0, 0, 0, 0]]))
    assert hopeless_cut(replace(grasp, certificate=replace(weak, cuts=weak.cuts[1:]))) is None


def test_nothing_is_said_to_be_hopeless_about_a_grasp() -> None:
    assert hopeless_cut(planned(OPPOSITE, [DOWN])) is None


def test_the_grip_is_the_largest_normal_force_and_less_than_rho() -> None:
    grasp = planned(OPPOSITE, [DOWN, [0.0, 0, 40, 0, 0, 0]])
    assert grasp.grip == pytest.approx(78.4, rel=1e-6)
    assert grasp.grip < grasp.rho
    assert planned(BESIDE, [DOWN]).grip == np.inf


PART = """<mujoco><worldbody><body name="part"><freejoint/>
<geom name="block" type="box" size="0.05 0.03 0.08" mass="8" friction="0.5"/></body></worldbody></mujoco>"""


def test_the_command_prints_the_grip_and_converts_no_infeasible_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("part.xml").write_text(PART)
    Path("lift.toml").write_text('[set]\nkind = "single"\nwrench = [0, 0, -78.4, 0, 0, 0]')
    Path("jaws.csv").write_text("0,0.03,0\n0,-0.03,0\n")
    given = ("grasp-plan", "part.xml", "--fingers", 2, "--task", "lift.toml", "--candidates")
    assert run(*given, "jaws.csv") == 0
    assert says(capsys.readouterr().out, "rho 87.6539 N: .* grip 78.4 N: the largest normal force of a finger")
    assert run(*given, "300") == 3
    assert says(
        capsys.readouterr().out, "every pair of these 300 candidates; the nearest .* mm may help candidates opp"
    )
    for out in ("part.glb", "part.isaac.yaml"):
        assert run("grasp-convert", "part.grasp.json", "--out", out) == 1
        assert says(
            capsys.readouterr().err, r"part.grasp.json holds no grasp \(status infeasible\): there is nothing to"
        )
        assert not Path(out).exists()
