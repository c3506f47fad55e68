"""Loads that only need support: no internal force fits the contacts' cones, and the grasp is true nevertheless."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.arrays import Floats
from planner.candidates.choice import make_candidates
from planner.contact_models.friction_cone import components
from planner.contacts import Contacts, grasp_maps
from planner.grasp_problem import GraspProblem
from planner.objects.mjcf.reader import read_object
from planner.objects.planar.reader import read_planar
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.task import make_task
from sim.commands.modes import MODES
from sim.commands.validate import Options
from sim.commands.validation_report import validation_lines, validation_summary
from sim.scene.units import units_of
from sim.trial.active import active_trial
from sim.trial.prediction import on_friction_limit, predicted_caps
from sim.trial.protocol import ACTIVE
from sim.trial.schedule import fractions
from sim.validation.document import to_document
from sim.validation.validation import validate
from sim.validation.verdict import Verdict
from tests.strategies.grasps_and_wrenches import grasp_and_wrench
from tests.strategies.support_loads import ORIGIN, WEIGHT, ball_on_fingers, bar_in_v_block, block_on_table, nose_cone
from tests.tools.commands import ASSETS

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("friction", [0.3, 0.6, 1.1])
def test_a_bar_in_a_v_block_needs_the_force_of_the_closed_form_and_is_confirmed(friction: float) -> None:
    """rho = W / (4 cos(45 deg - atan mu)), and W / 4 from mu = 1 on."""
    planned = bar_in_v_block(friction)
    pencil = WEIGHT / 4 / np.cos(max(np.pi / 4 - np.arctan(friction), 0.0))
    assert planned.phi.max() == pytest.approx(pencil, rel=1e-6)
    validation = planned.validated()
    assert validation.verdict, validation.reasons
    assert not validation.controls[0].outcomes[0].held  # at 0.98 rho it slips
    friction_control = validation.controls[2]
    assert friction_control.behaved and not all(outcome.expected for outcome in friction_control.outcomes)


@pytest.mark.parametrize("error", [0.95, 0.97])
def test_a_rho_too_low_for_the_v_block_is_refuted(error: float) -> None:
    assert bar_in_v_block(0.3).validated(rho_error=error).verdict is Verdict.FAIL


def test_less_friction_than_planned_is_noticed_where_friction_limits_and_not_where_it_does_not() -> None:
    assert not bar_in_v_block(0.3).validated(friction_error=0.8).verdict
    vertices = bar_in_v_block(1.1).validated(friction_error=0.95).vertices
    assert vertices is not None
    assert vertices.held.all()


@pytest.mark.parametrize("friction", [0.2, 0.5])
@pytest.mark.parametrize("tilt", [30.0, 60.0])
def test_a_ball_on_three_fingers_below_it_is_confirmed(friction: float, tilt: float) -> None:
    planned = ball_on_fingers(friction, tilt, sideways=0.1)
    validation = planned.validated()
    assert validation.verdict, validation.reasons


@pytest.mark.parametrize(("sides", "half_angle"), [(3, 50.0), (6, 45.0), (12, 60.0)])
def test_points_under_a_nose_cone_need_the_force_of_the_closed_form_and_are_confirmed(
    sides: int, half_angle: float
) -> None:
    """Straight down, each finger carries a third, along its normal tilted by the friction angle towards the axis."""
    planned = nose_cone(sides, half_angle, 0.3)
    upward = np.arccos(planned.contacts.normals[0, 2])
    assert planned.phi[0] == pytest.approx(WEIGHT / 3 / np.cos(upward - np.arctan(0.3)), rel=1e-6)
    validation = planned.validated()
    assert validation.verdict, validation.reasons
    assert planned.validated(rho_error=0.97).verdict is Verdict.FAIL


def test_fingers_that_cannot_squeeze_are_tested_for_creep_under_a_light_load() -> None:
    validation = bar_in_v_block(0.3).validated()
    creep = validation.controls[1]
    assert "cannot squeeze; 0.5 of critical wrench 0" in creep.change
    assert creep.behaved and all(outcome.counted for outcome in creep.outcomes)


def test_a_soft_instrument_is_not_trusted_with_a_support_load_either() -> None:
    soft = replace(ACTIVE, solimp=(0.9, 0.95, 1e-3, 0.5, 2.0), impratio=1.0)
    assert not bar_in_v_block(0.3).validated(protocol=soft).verdict


def test_a_load_at_the_edge_of_the_friction_cone_is_recognised() -> None:
    for sideways, expected in ((0.3999, True), (0.395, True), (0.38, False)):
        planned = block_on_table(sideways)
        limited = on_friction_limit(planned.contacts, ORIGIN, planned.wrenches, ACTIVE.friction_margin)
        assert limited.tolist() == [expected]


def test_loads_on_the_friction_limit_are_listed_in_output_and_file_also_when_they_hold() -> None:
    limited, free = block_on_table(0.395), block_on_table(0.3)
    both = replace(limited, wrenches=np.vstack([free.wrenches, limited.wrenches]))
    validation = both.validated()
    assert validation.vertices is not None and validation.vertices.held.all()
    (line,) = [line for line in validation_lines(validation) if line.startswith("limit ")]
    assert "1 of 2 wrenches lie on the friction limit (1)" in line and "1 of them held" in line
    assert to_document(validation).friction_limited == (1,)
    assert validation_summary(validation)["friction_limited"] == [1]
    assert not any(line.startswith("limit ") for line in validation_lines(free.validated()))


def test_what_moved_is_said_in_millimetres_and_degrees() -> None:
    (reason, *_) = bar_in_v_block(0.3).validated(rho_error=0.95).reasons
    assert " mm and turned " in reason and " degrees (allowed " in reason and " rad" not in reason


def test_a_load_on_the_friction_limit_that_slips_is_neither_a_pass_nor_a_fail() -> None:
    validation = block_on_table(0.3999).validated(friction_error=0.98)
    assert validation.verdict is Verdict.NOT_TRUSTWORTHY
    assert (
        "lie on the friction limit" in validation.reasons[0] and "98% of the planned friction" in validation.reasons[0]
    )


def supporting(seed: int) -> tuple[Contacts, Floats, float]:
    """A random grasp from below only, which cannot squeeze, a load that it carries, and the cap that this needs."""
    rng = np.random.default_rng(seed)
    fingers = int(rng.integers(3, 6))
    around = 2 * np.pi * (np.arange(fingers) + rng.uniform(-0.3, 0.3, size=fingers)) / fingers
    polar = rng.uniform(0.2, 0.9, size=fingers)
    points = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), -np.cos(polar)], axis=1)
    contacts = Contacts(points=points, normals=-points, friction=np.full(fingers, rng.uniform(0.05, 0.4)))
    pushes = contacts.normals * rng.uniform(0.5, 1, size=(fingers, 1)) + 0.01 * rng.normal(size=(fingers, 3))
    wrench = -np.einsum("iDd,id->D", grasp_maps(points, ORIGIN), pushes)
    return contacts, wrench, float(predicted_caps(contacts, ORIGIN, wrench[None])[0])


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), drawn=st.sampled_from([grasp_and_wrench, supporting]))
def test_every_instant_of_the_schedule_is_balanced_capped_and_in_the_true_cones(
    seed: int, drawn: Callable[[int], tuple[Contacts, Floats, float]]
) -> None:
    contacts, wrench, phi = drawn(seed)
    assume(np.isfinite(phi))
    units = units_of(contacts, ORIGIN, float(phi), ACTIVE.reach)
    trial = active_trial(contacts, units, wrench[None], np.array([ACTIVE.hold_factor]), ACTIVE)
    maps = grasp_maps(units.contacts(contacts).points, ORIGIN)
    for squeeze, load in fractions(ACTIVE)[::10]:
        loads, forces = trial.at(squeeze, load)
        np.testing.assert_allclose(np.einsum("iDd,id->D", maps, forces[0]), -loads[0], atol=1e-5)
        normal, tangential = components(forces[0], contacts.normals)
        assert (tangential <= contacts.friction * normal + 1e-5).all()
        assert (np.linalg.norm(forces[0], axis=1) <= trial.caps[0] * (1 + 1e-6)).all()


def test_a_mug_that_is_poured_is_confirmed_and_the_verdict_explains_its_unit_of_slip() -> None:
    mug = read_object(ASSETS / "mug" / "mug.xml")
    task = make_task(str(ASSETS / "tasks" / "pour.toml"), mug)
    grasp = plan(GraspProblem(mug, task, make_candidates(mug, "100", 0.5, seed=0), 3), CertifiedSearch(gap=0.01))
    validation = validate(mug, grasp)
    assert validation.verdict, validation.reasons
    assert any(line.startswith("R0 ") and "largest distance" in line for line in validation_lines(validation))
    options = Options(file=Path("mug.grasp.json"), mode="dexgraspbench")
    lines = MODES["dexgraspbench"][1](mug, grasp, options, lambda *_: None).lines
    assert "this is not about rho" in lines[1]


def test_a_square_on_its_corner_in_the_plane_is_confirmed(tmp_path: Path) -> None:
    """Two fingers under the lower edges, 45 degrees off the weight: rho = W / (2 cos(45 deg - atan mu))."""
    (tmp_path / "square.toml").write_text(
        'format = "rhograsp.planar"\nname = "square"\nmass = 1.0\nfriction = 0.3\nthickness = 0.01\n'
        "outline = [[0, -0.03], [0.03, 0], [0, 0.03], [-0.03, 0]]\n"
    )
    (tmp_path / "rest.csv").write_text("-0.015,-0.015\n0.015,-0.015\n")
    (tmp_path / "rest.toml").write_text('[set]\nkind = "single"\nwrench = [0, -9.81, 0]\n')
    square = read_planar(tmp_path / "square.toml")
    task = make_task(str(tmp_path / "rest.toml"), square)
    grasp = plan(GraspProblem(square, task, make_candidates(square, str(tmp_path / "rest.csv"), 0.3, seed=0), 2))
    assert grasp.rho == pytest.approx(WEIGHT / 2 / np.cos(np.pi / 4 - np.arctan(0.3)), rel=1e-6)
    validation = validate(square, grasp)
    assert validation.verdict, validation.reasons
