"""Units of the experiment: the same numbers for a die and for a car.

With R0 the largest distance of a contact from the reference point p_o, L the reach and rho the predicted
force, positions map to (p - p_o) L / R0, torsional friction to gamma L / R0, forces to f / rho and moments to
m L / (R0 rho). Statics do not change under this map; the gains, masses and tolerances of the protocol can then be
constants.
"""

from dataclasses import dataclass, replace

import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError

WHAT_R0_IS = "the largest distance of a contact from the reference point"
"""For those who read it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Units:
    """Map from the body frame in SI to the experiment: same axes, origin at p_o, its own metre and newton."""

    reference_point: np.ndarray
    """p_o, shape (3,) [m]."""

    length: float
    """Metres of the experiment per metre."""

    force: float
    """Newtons of the experiment per newton."""

    def points(self, points: np.ndarray) -> np.ndarray:
        """Map positions, shape (..., 3)."""
        return (points - self.reference_point) * self.length

    def wrenches(self, wrenches: np.ndarray) -> np.ndarray:
        """Map wrenches about p_o, shape (..., 6)."""
        return wrenches * self.force * np.repeat([1.0, self.length], 3)

    def contacts(self, contacts: Contacts) -> Contacts:
        """Map contact points and torsional friction, a length; normals, friction and strengths have no unit."""
        torsion = None if contacts.torsion is None else contacts.torsion * self.length
        return replace(contacts, points=self.points(contacts.points), torsion=torsion)


def units_of(contacts: Contacts, reference_point: np.ndarray, rho: float, reach: float) -> Units:
    """The map under which the farthest contact is `reach` from the origin and rho is one newton.

    Raises:
        SimulationError: When the grasp is planar, rho is not positive and finite, or every contact is at p_o.
    """
    if contacts.dimension != 3:
        raise SimulationError(
            "only grasps in space can be simulated; lift a planar one first (planner.grasps.lift.in_space)"
        )
    if not (np.isfinite(rho) and rho > 0):
        raise SimulationError(f"rho is {rho} N; a simulation needs a positive, finite force cap")
    farthest = float(np.linalg.norm(contacts.points - reference_point, axis=1).max(initial=0))
    if not farthest > 0:
        raise SimulationError("no contact away from the reference point: the grasp has no size to scale by")
    return Units(reference_point=reference_point, length=reach / farthest, force=1 / rho)
