"""Predicted against measured contact forces: do the fingers push as the theory says?"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from sim.trial.measurement import Measurement


@dataclass(frozen=True, kw_only=True)
class ForceAgreement:
    """How far the contact forces of loaded fingers in MuJoCo are from the predicted ones."""

    largest: float
    """Largest deviation of a force's norm, relative to the finger's cap."""

    typical: float
    """Median deviation of a force's norm, relative to the finger's cap."""

    wrench: int
    """Where the largest deviation is: the wrench."""

    finger: int
    """Where the largest deviation is: the finger."""

    largest_utilisation: float
    """Largest deviation of |f_t| / f_n, relative to the friction coefficient. Where fingers have torsional friction a
    torque counts too, and how they share one is not commanded."""

    typical_utilisation: float
    """Median deviation of the same, relative to the friction coefficient."""

    highest_utilisation: float
    """Largest measured utilisation, relative to the friction coefficient: at one a finger slides."""


def force_agreement(vertices: Measurement, friction: Floats, strengths: Floats) -> ForceAgreement:
    """Compare the forces of every wrench and finger.

    Args:
        vertices: One simulation per wrench.
        friction: Friction in the simulator, shape (contacts,).
        strengths: Of the fingers, shape (contacts,): each one's cap is the simulation's times its strength.
    """
    loaded = vertices.loaded
    forces = np.where(loaded, np.abs(vertices.measured_forces - vertices.predicted_forces), 0.0)
    forces = forces / (vertices.caps[:, None] * strengths)
    slopes = np.abs(vertices.measured_utilisations - vertices.predicted_utilisations) / friction
    wrench, finger = np.unravel_index(forces.argmax(), forces.shape)
    return ForceAgreement(
        largest=float(forces.max()),
        typical=float(np.median(forces[loaded])) if loaded.any() else 0.0,
        wrench=int(wrench),
        finger=int(finger),
        largest_utilisation=float(slopes.max()),
        typical_utilisation=float(np.median(slopes[loaded])) if loaded.any() else 0.0,
        highest_utilisation=float((vertices.measured_utilisations / friction).max()),
    )
