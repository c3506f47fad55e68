"""The measured counterpart of phi and rho: the least cap with which MuJoCo holds each wrench, by bisection.

Each wrench is scaled to a predicted cap of rho, so that all are measured with the same relative accuracy;
all are bisected together, one batch per halving.
"""

from dataclasses import dataclass

import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.objects.rigid_object import RigidObject
from sim.experiment import check_wrenches, set_up
from sim.protocol import ACTIVE, ValidationProtocol

SPAN = 0.1
"""The bisection starts from a band of this half width about the prediction."""
HALVINGS = 7
"""They narrow the band to 0.16 % of the prediction."""


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


def measure_critical_force(
    rigid_object: RigidObject,
    contacts: Contacts,
    reference_point: np.ndarray,
    wrenches: np.ndarray,
    phi: np.ndarray,
    protocol: ValidationProtocol = ACTIVE,
    simulated_friction: np.ndarray | None = None,
) -> CriticalForce:
    """Bisect the cap of every wrench.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp, with the planned friction.
        reference_point: p_o, shape (3,) [m].
        wrenches: Vertices of W_R about p_o, shape (wrenches, 6) [N, N m].
        phi: Predicted cap of every wrench, positive, shape (wrenches,) [N].
        protocol: Settings and thresholds.
        simulated_friction: Friction in the simulator, shape (contacts,); the planned one if None.

    Raises:
        SimulationError: When a fingertip is not where it was planned, a prediction is not positive and finite, or
            the experiment cannot be built or run.
    """
    check_wrenches(wrenches, phi)
    if not (np.isfinite(phi) & (phi > 0)).all():
        raise SimulationError(f"phi must be positive and finite to be measured; the least is {phi.min()} N")
    friction = contacts.friction if simulated_friction is None else np.asarray(simulated_friction, dtype=float)
    rho = float(phi.max())
    experiment = set_up(rigid_object, contacts, reference_point, rho, friction, protocol)
    if experiment.static.reasons():
        raise SimulationError("; ".join(experiment.static.reasons()))
    scaled = wrenches * (rho / phi)[:, None]
    slipped, held = np.full(len(phi), 1 - SPAN), np.full(len(phi), 1 + SPAN)
    ends = experiment.measure(np.vstack([scaled, scaled]), np.concatenate([slipped, held])).held
    holds_low, holds_high = np.split(ends, 2)
    for _ in range(HALVINGS):
        middle = (slipped + held) / 2
        holds = experiment.measure(scaled, middle).held
        slipped, held = np.where(holds, slipped, middle), np.where(holds, middle, held)
    lower = np.where(holds_low, 0.0, np.where(holds_high, slipped, 1 + SPAN))
    upper = np.where(holds_low, 1 - SPAN, np.where(holds_high, held, np.inf))
    return CriticalForce(phi=phi, lower=lower * phi, upper=upper * phi)
