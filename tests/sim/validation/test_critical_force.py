"""The measured least caps agree with the predicted ones, also with another friction in the simulator."""

from dataclasses import replace

import numpy as np
import pytest

from planner.arrays import Floats
from planner.errors import SimulationError
from sim.validation.critical_force import CriticalForce, measure_critical_force
from tests.strategies.planned_grasps import Planned, prism, with_friction
from tests.tools.lanes import first_fast

CORNER = replace(prism(), wrenches=prism().wrenches[::8])
"""Every eighth wrench of the paper's Case III."""


def measured(planned: Planned, phi: Floats, simulated_friction: float) -> CriticalForce:
    return measure_critical_force(replace(planned.loaded, phi=phi), simulated_friction=np.full(3, simulated_friction))


@pytest.mark.parametrize("friction", first_fast([0.29, 0.3, 0.31]))
def test_the_measured_caps_are_those_the_theory_predicts_for_the_simulated_friction(friction: float) -> None:
    critical = measured(CORNER, CORNER.phi, friction)
    theory = with_friction(CORNER, (friction,) * 3).phi
    assert (critical.lower < 1.003 * theory).all()
    assert (critical.upper > 0.997 * theory).all()
    assert (critical.upper - critical.lower < 0.002 * critical.phi).all()
    assert critical.rho[0] <= 1.003 * theory.max() and critical.rho[1] >= 0.997 * theory.max()


def test_a_cap_outside_the_searched_band_is_bracketed_openly() -> None:
    phi = CORNER.phi
    too_high, too_low = phi[0] * 1.6, phi[1] / 1.6
    critical = measured(replace(CORNER, wrenches=CORNER.wrenches[:2]), np.array([too_high, too_low]), 0.3)
    assert critical.lower[0] == 0 and critical.upper[0] == pytest.approx(0.7 * too_high)
    assert critical.lower[1] == pytest.approx(1.3 * too_low) and np.isinf(critical.upper[1])


def test_a_prediction_of_zero_cannot_be_measured() -> None:
    with pytest.raises(SimulationError, match="positive and finite"):
        measured(CORNER, np.zeros(8), 0.3)
