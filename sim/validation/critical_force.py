"""The measured counterpart of phi and rho: the least cap with which MuJoCo holds each wrench, by bisection.

Each wrench is scaled to a predicted cap of rho, so that all are measured with the same relative accuracy, and all
are bisected together. The search starts from a narrow band about the prediction, both ends of every wrench in
one go, and widens the band only for the wrenches whose cap lies outside it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, log2

import numpy as np

from planner.errors import SimulationError
from sim.trial.experiment import Experiment, set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.protocol import ValidationProtocol

BANDS = (0.005, 0.02, 0.1, 0.3)
"""Half widths of the bands about the prediction that are searched, narrowest first."""
RESOLUTION = 0.0015
"""A bracket narrower than this part of the prediction is not halved."""
MOST_HALVINGS = 8
"""Enough for the gap between the two widest bands."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CriticalForce:
    """Brackets of the measured least cap of every wrench."""

    phi: np.ndarray
    """Predicted, shape (wrenches,) [N]."""

    lower: np.ndarray
    """Largest cap that was seen to slip, shape (wrenches,) [N]; zero if even the lowest held."""

    upper: np.ndarray
    """Least cap that was seen to hold, shape (wrenches,) [N]; infinite if even the highest slipped."""

    @property
    def rho(self) -> tuple[float, float]:
        """Bracket of the grasp's measured rho, the cap that holds every wrench [N]."""
        return float(self.lower.max()), float(self.upper.max())

    @property
    def ratios(self) -> np.ndarray:
        """Middle of every bracket over its prediction, shape (wrenches,); infinite if even the highest slipped."""
        return (self.lower + self.upper) / (2 * self.phi)

    @property
    def ratio(self) -> float:
        """Middle of the bracket of the measured rho over the predicted rho."""
        return sum(self.rho) / (2 * float(self.phi.max()))

    @property
    def critical_wrench(self) -> int:
        """The wrench with the largest measured cap."""
        return int((self.lower + self.upper).argmax())


def measure_critical_force(
    grasp: LoadedGrasp,
    protocol: ValidationProtocol | None = None,
    simulated_friction: np.ndarray | None = None,
    observe: Callable[[float, float], None] = lambda *_: None,
) -> CriticalForce:
    """Bisect the cap of every wrench.

    Args:
        grasp: What is measured, every prediction positive.
        protocol: Settings and thresholds; by default those for such contacts, `active_protocol`.
        simulated_friction: Friction in the simulator, shape (contacts,), with the torsional friction that goes with
            it; the planned one if None.
        observe: Called now and then with how many simulations are done and how many are expected in all.

    Raises:
        SimulationError: When a fingertip is not where it was planned, a prediction is not positive and finite, or
            the experiment cannot be built or run.
    """
    grasp.require_predictions()
    experiment = set_up(grasp, protocol, simulated_friction)
    if experiment.static.reasons():
        raise SimulationError("; ".join(experiment.static.reasons()))
    return bisect_caps(experiment, observe)


def expected_simulations(wrenches: int) -> int:
    """Simulations of a bisection when every cap lies in the narrowest band: its ends, and the halvings of the rest."""
    return wrenches * (2 + ceil(log2(2 * BANDS[0] / RESOLUTION)))


def bisect_caps(experiment: Experiment, observe: Callable[[float, float], None] = lambda *_: None) -> CriticalForce:
    """The same in an experiment that is set up and whose fingertips touch where planned.

    Args:
        experiment: Of a grasp whose predictions are positive and finite.
        observe: Called now and then with how many simulations are done and how many are expected in all.

    Raises:
        SimulationError: When MuJoCo stops or loses a simulation.
    """
    wrenches, phi = experiment.grasp.wrenches, experiment.grasp.phi
    scaled = wrenches / (experiment.units.force * phi)[:, None]
    slipped, held = np.zeros(len(phi)), np.full(len(phi), np.inf)

    finished = 0

    def test(rows: np.ndarray, caps: np.ndarray) -> None:
        """Simulate wrenches `rows` at these multiples of their phi and draw the brackets in."""
        nonlocal finished
        before, expected = finished, max(finished + len(rows), expected_simulations(len(phi)))
        finished += len(rows)
        holds = experiment.measure(scaled[rows], caps, lambda done: observe(before + done, expected)).held
        np.minimum.at(held, rows[holds], caps[holds])
        np.maximum.at(slipped, rows[~holds], caps[~holds])

    for band in BANDS:
        low, high = np.flatnonzero(slipped == 0), np.flatnonzero(np.isinf(held))
        if low.size + high.size:
            test(np.concatenate([low, high]), np.repeat([1 - band, 1 + band], [low.size, high.size]))
    for _ in range(MOST_HALVINGS):
        wide = np.flatnonzero((slipped > 0) & np.isfinite(held) & (held - slipped > RESOLUTION))
        if not wide.size:
            break
        test(wide, (slipped[wide] + held[wide]) / 2)
    return CriticalForce(phi=phi, lower=slipped * phi, upper=held * phi)
