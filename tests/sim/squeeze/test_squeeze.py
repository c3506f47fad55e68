"""The passive squeeze in MuJoCo needs what its own theory predicts, which is more than rho."""

from functools import cache
from pathlib import Path

import msgspec
import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.contacts import Contacts
from planner.grasp_problem import GraspProblem
from planner.objects.mjcf.reader import read_object
from planner.planning import plan
from planner.task import make_task
from sim.commands.modes import MODES
from sim.commands.validate import Options
from sim.squeeze.document import FORMAT, SqueezeDocument, to_document, write_squeeze
from sim.squeeze.squeeze import SQUEEZE, SqueezeForce, measure_squeeze_force
from sim.trial.loaded_grasp import LoadedGrasp
from tests.strategies.parts import box, rigid_object
from tests.strategies.planned_grasps import Planned, prism
from tests.tools.commands import ASSETS


def squeezed(planned: Planned, friction_error: float = 1.0) -> SqueezeForce:
    return measure_squeeze_force(planned.loaded, simulated_friction=friction_error * planned.contacts.friction)


@cache
def case_iii() -> SqueezeForce:
    """The paper's Case III, measured once."""
    return squeezed(prism())


def test_the_papers_case_iii_needs_the_predicted_squeeze_within_one_percent() -> None:
    squeeze = case_iii()
    assert squeeze.confirmed
    assert squeeze.predicted.squeeze_force == pytest.approx(1.300 * prism().phi.max(), rel=1e-3)
    assert squeeze.upper - squeeze.lower < 0.004 * squeeze.predicted.squeeze_force


@pytest.mark.slow
def test_four_fingers_on_the_mug_need_the_predicted_squeeze_within_one_percent() -> None:
    mug = read_object(ASSETS / "mug" / "mug.xml")
    task = make_task("gravity", mug)
    grasp = plan(GraspProblem(mug, task, make_candidates(mug, "50", None, seed=0), 4))
    squeeze = measure_squeeze_force(LoadedGrasp.of(mug, grasp))
    assert squeeze.confirmed, (squeeze.lower, squeeze.upper, squeeze.predicted.squeeze_force)
    assert squeeze.lower > grasp.rho


def test_two_opposed_fingers_are_measured_to_need_weight_over_twice_the_friction() -> None:
    points, weight, friction = np.array([(-0.05, 0, 0), (0.05, 0, 0)]), 3.0, 0.4
    contacts = Contacts(points=points, normals=np.sign(-points), friction=np.full(2, friction))
    down = np.array([[0, 0, -weight, 0, 0, 0]])
    squeeze = squeezed(
        Planned(parts=(box((0.05, 0.02, 0.03)),), contacts=contacts, reference_point=np.zeros(3), wrenches=down)
    )
    pencil = weight / 2 * np.hypot(1, 1 / friction)
    assert squeeze.lower > 0.995 * pencil and squeeze.upper < 1.005 * pencil


@pytest.mark.slow
def test_five_percent_less_friction_needs_more_than_predicted() -> None:
    squeeze = squeezed(prism(), friction_error=0.95)
    assert not squeeze.confirmed
    assert squeeze.lower > 1.02 * squeeze.predicted.squeeze_force


def test_no_preload_against_a_moment_about_the_line_of_two_fingers() -> None:
    points = np.array([(-0.05, 0, 0), (0.05, 0, 0)])
    contacts = Contacts(points=points, normals=np.sign(-points), friction=np.full(2, 0.4))
    spin = np.array([[0, 0, 0, 0.01, 0, 0]])
    squeeze = squeezed(
        Planned(parts=(box((0.05, 0.02, 0.03)),), contacts=contacts, reference_point=np.zeros(3), wrenches=spin)
    )
    assert not squeeze.confirmed and squeeze.lower == 0 and np.isinf(squeeze.upper)
    document = to_document(squeeze, rigid_object(*prism().parts), rho=1.0, grasp=None)
    assert document.squeeze_force is None and document.measured_upper is None and document.preload is None
    assert document.measured_lower is None


def test_what_is_written_is_read_back_with_every_setting(tmp_path: Path) -> None:
    path, held = tmp_path / "prism.squeeze.json", rigid_object(*prism().parts)
    write_squeeze(path, case_iii(), held, rho=0.669, grasp="prism.grasp.json")
    document = msgspec.json.decode(path.read_bytes(), type=SqueezeDocument)
    assert document == to_document(case_iii(), held, rho=0.669, grasp="prism.grasp.json")
    assert document.format == FORMAT and document.protocol == SQUEEZE


def test_the_command_says_that_no_constant_squeeze_can_hold_a_load_that_only_needs_support(tmp_path: Path) -> None:
    (tmp_path / "bar.xml").write_text(
        '<mujoco><worldbody><body name="bar"><freejoint/><geom type="box" size=".02 .06 .02" mass="1"/></body>'
        "</worldbody></mujoco>"
    )
    (tmp_path / "rest.csv").write_text("-0.02,0.04,0\n-0.02,-0.04,0\n0,0.04,-0.02\n0,-0.04,-0.02\n")
    (tmp_path / "rest.toml").write_text('[set]\nkind = "single"\nwrench = [-7, 0, -7, 0, 0, 0]\n')
    bar = read_object(tmp_path / "bar.xml")
    task = make_task(str(tmp_path / "rest.toml"), bar)
    grasp = plan(GraspProblem(bar, task, make_candidates(bar, str(tmp_path / "rest.csv"), 0.3, seed=0), 4))
    options = Options(file=tmp_path / "bar.grasp.json", mode="squeeze")
    outcome = MODES["squeeze"][1](bar, grasp, options, lambda *_: None)
    assert not outcome.passed
    assert "no constant squeeze can hold this load" in outcome.lines[0]
    assert "inf" not in " ".join(outcome.lines)
    assert outcome.summary["squeeze_force"] is outcome.summary["measured_upper"] is None
    assert not outcome.summary["holdable"]
