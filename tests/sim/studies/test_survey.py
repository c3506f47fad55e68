"""Surveys: no wrong verdict on random grasps, and every wrong planner is noticed."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from planner.forces.problem import ForceProblem
from planner.objects.mjcf.reader import read_object
from sim.studies.cost import measure_cost
from sim.studies.fault_injection import INJECTED_FAULTS, PyramidForces, SquareForces, measure_fault
from sim.studies.rho_table import rho_rows
from sim.studies.survey import Pad, random_grasps, tally
from sim.trial.loaded_grasp import LoadedGrasp
from tests.strategies.planned_grasps import prism
from tests.strategies.support_loads import block_on_table
from tests.tools.commands import ASSETS
from tests.tools.lanes import first_fast

BOX = read_object(ASSETS / "box" / "box.xml")


@cache
def grasp() -> LoadedGrasp:
    """Some wrenches of the paper's Case III."""
    planned = prism()
    return replace(planned, wrenches=planned.wrenches[6::16]).loaded


def test_no_single_wrench_of_random_grasps_is_judged_wrongly() -> None:
    grasps = random_grasps([BOX], 2, seed=3, task="axes6")
    below, above = tally(grasps, (0.99, 1.01))
    assert below.tests == above.tests == 12
    assert below.wrong == above.wrong == 0
    assert above.worst_slip < 1e-4 < below.worst_slip


def test_no_single_wrench_of_random_soft_grasps_is_judged_wrongly() -> None:
    grasps = random_grasps([BOX], 4, seed=1, task="axes6", soft=True)
    assert [len(grasp.contacts) for grasp in grasps] == [2, 3, 2, 3]
    torsions = [grasp.contacts.torsions for grasp in grasps]
    assert all(torsion.any() for torsion in torsions)
    assert torsions[0].all() and torsions[1].all() and not (torsions[2].all() and torsions[3].all())
    below, above = tally(grasps, (0.99, 1.01))
    assert below.tests == above.tests == 24
    assert below.wrong == above.wrong == 0
    assert above.worst_spin < 6e-5 and above.worst_slip < 1e-4


def test_two_soft_fingers_of_a_planned_asset_are_measured_within_a_tenth_of_a_percent() -> None:
    (row,) = rho_rows([BOX], [2], [Pad(friction=0.6, patch=0.004)], task="axes6", candidates="30")
    assert row.note == "" and row.patch == 0.004 and 0.999 < row.ratio < 1.001


def test_a_wrong_prediction_is_counted_as_wrong_verdicts() -> None:
    honest = grasp()
    wrong = replace(honest, phi=1.05 * honest.phi)
    below, above = tally([wrong], (0.99, 1.01))
    assert below.wrong == below.tests == 4 and above.wrong == 0


def test_wrenches_on_the_friction_limit_are_tallied_by_themselves() -> None:
    pushed = block_on_table(0.395).loaded
    (below,) = tally([grasp(), pushed], (0.97,))
    assert (below.tests, below.limited) == (4, 1)


EXPECTED = {
    "none": (0.995, 1.005),
    "4-sided inscribed pyramid": (0.7, 0.95),
    "8-sided inscribed pyramid": (0.93, 0.99),
    "wrench 3 % larger in truth": (1.025, 1.035),
    "friction 5 % lower in truth": (1.02, 1.06),
    "moment sign wrong": (np.inf, np.inf),
}


@pytest.mark.parametrize("name", first_fast(EXPECTED))
def test_a_wrong_planner_is_noticed_as_far_off_as_it_is(name: str) -> None:
    fault = next(each for each in INJECTED_FAULTS if each.name == name)
    critical = measure_fault(grasp(), fault)
    assert critical is not None
    low, high = EXPECTED[name]
    assert low <= critical.ratio <= high


def test_an_inscribed_pyramid_needs_more_and_with_many_sides_no_more_than_the_cone() -> None:
    class ManySides(PyramidForces):
        sides = 64

    case = grasp()
    problem = ForceProblem(contacts=case.contacts, reference_point=case.reference_point, wrench=case.wrenches[0])
    assert SquareForces(3, 3).solve(problem).phi > 1.02 * case.phi[0]
    assert ManySides(3, 3).solve(problem).phi == pytest.approx(case.phi[0], rel=2e-3)


@pytest.mark.slow
def test_a_planned_asset_is_measured_within_half_a_percent_and_an_impossible_one_is_noted() -> None:
    good, bad = rho_rows([BOX], [2, 3][::-1], [Pad(friction=0.6)], task="axes6", candidates="30")
    assert good.note == "" and 0.995 < good.ratio < 1.005
    assert bad.fingers == 2 and (bad.note == "" or np.isnan(bad.lower))


def test_costs_are_measured_stage_by_stage() -> None:
    cost = measure_cost(3, 2, bisect=True)
    assert 0.995 < cost.ratio < 1.005
    assert min(cost.set_up, cost.forces, cost.stepping) > 0 and cost.measuring > cost.stepping
