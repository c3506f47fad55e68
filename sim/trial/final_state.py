"""Where everything is when a batch of simulations ends."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False, kw_only=True)
class FinalState:
    """Where everything is at the end, per simulation, in the units of the experiment."""

    object_positions: np.ndarray
    """Displacement of the object, shape (simulations, 3) [m]."""

    object_quaternions: np.ndarray
    """Rotation of the object (w, x, y, z), shape (simulations, 4)."""

    tip_displacements: np.ndarray
    """Displacements of the fingertips from their anchors, shape (simulations, contacts, 3) [m]."""

    touching: np.ndarray
    """Whether each fingertip touches the object, shape (simulations, contacts)."""

    contact_forces: np.ndarray
    """Measured contact forces in contact frames, normal first, shape (simulations, contacts, 3) [N]."""

    @property
    def translations(self) -> np.ndarray:
        """Displacement of the object, shape (simulations,) [m]."""
        return np.linalg.norm(self.object_positions, axis=1)

    @property
    def rotations(self) -> np.ndarray:
        """Rotation of the object, shape (simulations,) [rad]."""
        return angles(self.object_quaternions)


def angles(quaternions: np.ndarray) -> np.ndarray:
    """Angles of rotations (w, x, y, z), shape (n, 4), as shape (n,) [rad]."""
    return 2 * np.arctan2(np.linalg.norm(quaternions[:, 1:], axis=1), np.abs(quaternions[:, 0]))
