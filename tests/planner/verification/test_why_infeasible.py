"""What is said about an infeasible task is true of its candidates, and what is said to help does help."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.candidates.listed import listed_candidates
from planner.commands.with_pads import planned_with_pads
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.limits.limits import Finger, Limits
from planner.planning import plan
from planner.search.result import Status
from planner.task import Task, make_task
from planner.verification.why_infeasible import hopeless_cut, reasons, remedies
from sim.report.report_data import hopeless_wrench
from tests.strategies.parts import box, rigid_object
from tests.tools.commands import run, says

BRICK = rigid_object(box((0.05, 0.03, 0.08)))
DOWN = [0.0, 0, -78.4, 0, 0, 0]


def problem(
    points: Sequence[tuple[float, ...]],
    wrenches: Sequence[Sequence[float]],
    fingers: int = 2,
    torsion: float | None = None,
) -> GraspProblem:
    task = Task(name="load", reference_point=np.zeros(3), wrenches=np.array(wrenches, dtype=float))
    candidates = listed_candidates(BRICK, np.array(points, dtype=float), 0.5).twisting(torsion, None)
    return GraspProblem(BRICK, task, candidates, fingers)


def planned(
    points: Sequence[tuple[float, ...]],
    wrenches: Sequence[Sequence[float]],
    fingers: int = 2,
    torsion: float | None = None,
) -> Grasp:
    return plan(problem(points, wrenches, fingers, torsion))


BESIDE = [(0.01, 0.03, 0.0), (0.02, -0.03, 0.0), (0.0, 0.03, 0.02), (0.03, -0.03, 0.01)]
OPPOSITE = [(0.0, 0.03, 0.0), (0.0, -0.03, 0.0)]


def test_pairs_beside_the_load_are_infeasible_and_opposite_ones_help_as_said() -> None:
    grasp = planned(BESIDE, [DOWN])
    assert grasp.status is Status.INFEASIBLE
    (reason,) = reasons(grasp)
    assert says(reason, "has one for every pair of these 4 candidates")
    assert "whichever" not in reason and "wherever" not in reason
    opposite, pads, third = remedies(grasp)[:3]
    assert says(opposite, r"opposite each other.*--candidates antipodal:300\), or listed in a CSV file$")
    assert says(pads, r"fingertips that resist turning: --patch 0.004 \(pads of 4 mm radius\), or --torsion; torsion")
    assert third == "a third finger"
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
    assert remedies(grasp)[1] == "a third finger"
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


ALL_AROUND = [[*row] for row in 10 * np.vstack([np.eye(6), -np.eye(6)]) * [1, 1, 1, 0.01, 0.01, 0.01]]
HALF = (0.05, 0.02, 0.07), (0.04, 0.03, -0.07), (0.04, -0.02, 0.08)
SKEW = [(sign * x, sign * y, sign * z) for sign in (1, -1) for x, y, z in HALF]
"""All around the brick, and none opposite another: the lines between them lean."""


def test_what_is_said_of_pads_is_what_a_plan_with_them_says() -> None:
    posed = problem(BESIDE + OPPOSITE, ALL_AROUND)
    grasp = plan(posed)
    padded = planned_with_pads(posed, grasp, left=np.inf)
    assert padded is not None and padded.status is Status.OPTIMAL
    given = plan(replace(posed, candidates=posed.candidates.twisting(None, 0.004)))
    assert padded.rho == pytest.approx(given.rho, rel=1e-6)
    said = remedies(grasp, padded)[0]
    assert says(
        said, rf"with --patch 0\.004 \(pads of 4 mm radius\) two of these candidates hold it with {given.rho:.3g} N;"
    )
    cut_short = remedies(grasp, replace(padded, status=Status.TIME_LIMIT))[0]
    assert says(cut_short, r" N or less;")


def test_torsion_times_force_is_never_less_than_said() -> None:
    """The product that is said is that of any torsion and the force it takes, and of a great one nearly so."""
    posed = problem(OPPOSITE, ALL_AROUND)
    (least,) = re.findall(r"torsion times force must be ([\d.]+) N mm", remedies(plan(posed))[0])
    assert float(least) == 50  # half of 10 N * 0.01 m
    products = [1e3 * torsion * planned(OPPOSITE, ALL_AROUND, torsion=torsion).rho for torsion in (1e-2, 1e-3, 1e-4)]
    assert all(product >= float(least) * (1 - 1e-7) for product in products)
    assert products[-1] == pytest.approx(float(least), rel=0.02)


def test_where_even_pads_hold_nothing_that_is_said_with_its_reason() -> None:
    posed = problem(SKEW, ALL_AROUND)
    grasp = plan(posed)
    padded = planned_with_pads(posed, grasp, left=np.inf)
    assert padded is not None and padded.status is Status.INFEASIBLE
    assert says(
        remedies(grasp, padded)[0], r"^other candidates; even with --patch 0\.004 .* no two of these hold it: loads"
    )
    assert "fingertips" not in "".join(remedies(grasp, padded))


def test_pads_are_tried_for_a_second_or_what_is_left_of_the_time() -> None:
    task = make_task("gravity", BRICK)
    posed = GraspProblem(BRICK, task, make_candidates(BRICK, "1000", 0.5), 2)
    few = plan(replace(posed, candidates=posed.candidates.kept(np.arange(2))))
    for left, most in ((np.inf, 1.0), (0.2, 0.2), (0.0, 0.0)):
        began = perf_counter()
        padded = planned_with_pads(posed, few, left)
        assert padded is not None
        assert perf_counter() - began < most + 2.5  # reading the candidates, and a busy machine
        assert padded.search.seconds < most + 1


def test_pads_are_not_tried_where_they_say_nothing() -> None:
    posed = problem(BESIDE, [DOWN])
    grasp = plan(posed)
    assert planned_with_pads(posed, grasp, left=np.inf) is not None
    hard = Limits(fingers=(Finger(torsion=0), Finger(torsion=0)))
    assert planned_with_pads(replace(posed, limits=hard), grasp, left=np.inf) is None
    soft = problem(SKEW, ALL_AROUND, torsion=0.002)
    assert planned_with_pads(soft, plan(soft), left=np.inf) is None
    held = problem(OPPOSITE, [DOWN])
    assert planned_with_pads(held, plan(held), left=np.inf) is None
    grain = rigid_object(box((0.002, 0.002, 0.002)))
    small = GraspProblem(grain, posed.task, listed_candidates(grain, np.array([(0.002, 0, 0), (0, 0.002, 0)]), 0.5), 2)
    assert planned_with_pads(small, plan(small), left=np.inf) is None


def test_soft_fingers_that_do_not_oppose_each_other_are_said_so_and_opposite_ones_help() -> None:
    grasp = planned(SKEW, ALL_AROUND, torsion=0.002)
    assert grasp.status is Status.INFEASIBLE
    (reason,) = reasons(grasp)
    missed = float(re.findall(r"misses that by ([\d.]+)°", reason)[0])
    apart = np.array([0.08, -0.04, 0.16])  # of the nearest pair, from the top to the bottom
    lean = np.arctan(np.hypot(0.08, 0.04) / 0.16) - np.arctan(0.5) - np.arcsin(0.004 / np.linalg.norm(apart))
    assert missed == float(f"{np.degrees(lean):.2g}")
    assert remedies(grasp)[:2] == [
        "candidates opposite each other: more of them (--candidates antipodal:3000), or listed in a CSV file",
        "a third finger",
    ]
    assert planned(SKEW + OPPOSITE, ALL_AROUND, torsion=0.002).status is Status.OPTIMAL


def test_soft_fingers_that_twist_too_weakly_are_said_so_and_larger_pads_help() -> None:
    grasp = planned(BESIDE + OPPOSITE, ALL_AROUND, torsion=1e-8)
    assert grasp.status is Status.INFEASIBLE
    (reason,) = reasons(grasp)
    assert says(reason, r"torsional friction of at most 0\.00001 mm does not hold with less than [\d.e+]+ N$")
    assert remedies(grasp)[0].startswith("fingertips that resist turning more")
    assert planned(BESIDE + OPPOSITE, ALL_AROUND, torsion=0.002).status is Status.OPTIMAL


def test_no_reason_is_made_up_for_soft_fingers() -> None:
    """One load cancels with none: two fingers beside each other fail for another reason, and the direction says it."""
    beside = [(0.05, 0.01, 0.0), (0.01, 0.03, 0.0)]
    (reason,) = reasons(planned(beside, [DOWN], torsion=0.002))
    assert says(reason, "no candidate can push or twist the object along it")
    stopped = replace(planned(SKEW, ALL_AROUND, torsion=0.002), status=Status.TIME_LIMIT)
    assert reasons(stopped) == [] and "third" not in "".join(remedies(stopped))


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
    said = capsys.readouterr().out
    assert says(said, "every pair of these 300 candidates; the nearest .* mm may help candidates opp")
    (force,) = re.findall(r"with --patch 0\.004 .* two of these candidates hold it with ([\d.]+) N", said)
    assert run(*given, "300", "--patch", 0.004, "--out", "pads.grasp.json") == 0
    (rho,) = re.findall(r"rho +([\d.]+) N", capsys.readouterr().out)
    assert float(force) == pytest.approx(float(rho), rel=2e-3)
    assert run(*given, "300", "--quiet") == 3
    for out in ("part.glb", "part.isaac.yaml"):
        assert run("grasp-convert", "part.grasp.json", "--out", out) == 1
        assert says(
            capsys.readouterr().err, r"part.grasp.json holds no grasp \(status infeasible\): there is nothing to"
        )
        assert not Path(out).exists()
