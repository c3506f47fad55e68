"""Finger forces that balance a wrench within a cap and lean on friction as little as possible.

    minimise k   subject to   sum_i G_i f_i = -w,   |t_i| <= k r_i n_i,   |f_i| <= s_i cap,

with n_i, t_i the normal and tangential parts of f_i, r_i the friction of contact i relative to the largest and
s_i the strength of finger i, usually 1. Where a finger twists, its torque times mu_i / gamma_i is one more component
of t_i and turns the object too (planner/contact_models/soft_finger.py); gamma_i / mu_i is a length of its patch. The
level of friction does not enter, so in the experiment only the simulator decides whether the forces hold. Because
phi(w, k r) falls as k grows (it is Subproblem 2 with friction k r), the least k is the root of phi(w, k r) = cap. The
variables are those of `planner.forces.minimax`.
"""

from typing import NamedTuple

import numpy as np

from planner.contact_models.models import model_of
from planner.contacts import Contacts, reach
from planner.forces.minimax import MinimaxForces

STEEPEST = np.deg2rad(89.0)
"""Largest friction angle the fingers ever count on [rad]."""
FLATTEST = 1e-3
"""Friction angle that counts as none [rad]: in a flatter cone solvers, to their accuracy, let fingers pull."""
ANGLE_TOLERANCE = 1e-6
"""Bracket of the least friction angle at which the search stops [rad]."""
CAP_TOLERANCE = 1e-4
"""Forces that reach the cap within this part have the least utilisation."""
MOST_SOLVES = 60
"""Bound on the search, which takes 5 or 6 solves."""
BISECTION_EVERY = 8
"""Every so many steps the bracket is halved: progress where phi jumps."""
PRESS = 1e3
"""Cap on the answer to a unit press along every normal, when an internal force is sought."""
ROUND_OFF = 1e-12
"""A sum of presses below this part of its terms is zero."""


class Push(NamedTuple):
    """What the fingers do."""

    forces: np.ndarray
    """In body axes, shape (contacts, d) [N]."""

    torques: np.ndarray
    """That balance takes beside them, about the inward normals, shape (contacts,) [N m]; none at hard fingers. No
    finger is told: a fingertip that does not turn holds what comes."""


class FeedForward:
    """Least-utilisation forces of one grasp. Not for several threads at once."""

    def __init__(self, contacts: Contacts, reference_point: np.ndarray) -> None:
        """
        Args:
            contacts: The grasp; of its friction only the ratios of the coefficients and gamma / mu are used.
            reference_point: Point the wrenches refer to, shape (d,) [m].
        """
        self._contacts, self._model = contacts, model_of(contacts)
        self._maps = self._model.maps(contacts, reference_point)
        self._ratios = contacts.friction / contacts.friction.max()
        self._length = reach(contacts.points, reference_point)
        self._solver = MinimaxForces(len(contacts), contacts.dimension, self._model)

    def answer(self, wrench: np.ndarray, cap: float) -> Push:
        """Forces that answer `wrench`.

        Where no friction whatever balances it within the cap, the best effort: the forces of the least
        largest norm under the steepest friction, scaled down to the cap, or none where these do not exist.

        Args:
            wrench: External wrench, shape (D,) [N, N m].
            cap: Largest force norm of a finger of strength 1 [N].

        """
        components, phi = self._least_utilisation(wrench, cap)
        if phi > cap:
            components = components * (cap / phi) if np.isfinite(phi) else np.zeros_like(components)
        return self._push(components)

    def squeeze(self, cap: float) -> Push:
        """Internal forces of little utilisation: they balance each other, the largest over its strength is `cap`.

        The fingers press along every normal, each with its strength, and answer their own press within PRESS
        units: press and answer together are balanced, and adding a normal leaves no cone. A grasp that cannot
        squeeze (one that only supports) gets no force.

        Args:
            cap: Largest force norm of a finger of strength 1 [N].
        """
        press = np.zeros_like(self._maps[:, 0])
        press[:, 0] = 1.0
        wrench = np.einsum("iDe,ie->D", self._maps, press)
        wrench[np.abs(wrench) <= ROUND_OFF * np.abs(self._maps[:, :, 0]).sum(axis=0)] = 0.0
        answer, phi = self._least_utilisation(wrench, PRESS)
        if phi > PRESS:
            return self._push(np.zeros_like(press))
        components = press + answer
        forces = components[:, : self._contacts.dimension]
        return self._push(components * (cap / float(np.linalg.norm(forces, axis=1).max())))

    def _least_utilisation(self, wrench: np.ndarray, cap: float) -> tuple[np.ndarray, float]:
        """Components of the forces, and their largest norm: above the cap only if no friction helps.

        Finds the friction angle where cap / phi - 1 changes sign (it is -1 where no forces exist) by the
        Illinois method: false position that halves the value of an end kept twice in a row.
        """
        best = self._solve(wrench, STEEPEST)
        low, high, low_value, high_value = 0.0, STEEPEST, -1.0, _margin(cap, best[1])
        kept = 0
        for step in range(MOST_SOLVES):
            if _margin(cap, best[1]) <= CAP_TOLERANCE or high - low <= ANGLE_TOLERANCE or high <= FLATTEST:
                break
            false_position = low - low_value / (high_value - low_value) * (high - low)
            angle = (low + high) / 2 if step % BISECTION_EVERY == BISECTION_EVERY - 1 else false_position
            angle = max(angle, FLATTEST)
            trial = self._solve(wrench, angle)
            value = _margin(cap, trial[1])
            if value >= 0:
                best, high, high_value = trial, angle, value
                low_value /= 2 if kept == 1 else 1
                kept = 1
            else:
                low, low_value = angle, value
                high_value /= 2 if kept == -1 else 1
                kept = -1
        return best

    def _push(self, components: np.ndarray) -> Push:
        forces = self._model.forces(self._contacts, components)
        return Push(forces, self._model.torques(self._contacts, components))

    def _solve(self, wrench: np.ndarray, angle: float) -> tuple[np.ndarray, float]:
        """Components of least largest force at one friction angle, and its norm; infinite if none exist."""
        components, phi, _ = self._solver.solve_arrays(self._maps, np.tan(angle) * self._ratios, wrench, self._length)
        return components, phi


def _margin(cap: float, phi: float) -> float:
    """cap / phi - 1: positive where the cap suffices."""
    return cap / phi - 1 if phi > 0 else np.inf
