"""Where everything is when a batch of simulations ends."""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Mask


@dataclass(frozen=True, eq=False, kw_only=True)
class FinalState:
    """Where everything is at the end, per simulation, in the units of the experiment."""

    object_positions: Floats
    """Displacement of the object, shape (simulations, 3) [m]."""

    object_quaternions: Floats
    """Rotation of the object (w, x, y, z), shape (simulations, 4)."""

    tip_displacements: Floats
    """Displacements of the fingertips from their anchors, shape (simulations, contacts, 3) [m]."""

    touching: Mask
    """Whether each fingertip touches the object, shape (simulations, contacts)."""

    contact_forces: Floats
    """Measured contact forces in contact frames, normal first, shape (simulations, contacts, 3) [N]."""

    @property
    def translations(self) -> Floats:
        """Displacement of the object, shape (simulations,) [m]."""
        return np.linalg.norm(self.object_positions, axis=1)

    @property
    def rotations(self) -> Floats:
        """Rotation of the object, shape (simulations,) [rad]."""
        return angles(self.object_quaternions)


def angles(quaternions: Floats) -> Floats:
    """Angles of rotations (w, x, y, z), shape (n, 4), as shape (n,) [rad]."""
    return 2 * np.arctan2(np.linalg.norm(quaternions[:, 1:], axis=1), np.abs(quaternions[:, 0]))
