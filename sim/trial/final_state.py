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

    contact_torques: np.ndarray
    """Measured torques of the contacts about their normals, shape (simulations, contacts) [N m]."""

    @property
    def translations(self) -> np.ndarray:
        """Displacement of the object, shape (simulations,) [m]."""
        return np.linalg.norm(self.object_positions, axis=1)

    @property
    def rotations(self) -> np.ndarray:
        """Rotation of the object, shape (simulations,) [rad]."""
        return angles(self.object_quaternions)

    def spins(self, normals: np.ndarray) -> np.ndarray:
        """How far each fingertip, which does not turn, spins on the object, shape (simulations, contacts) [rad].

        The part of the object's rotation vector along each normal, which for small rotations is the turn about it.

        Args:
            normals: Of the contacts, shape (contacts, 3).
        """
        axes = self.object_quaternions[:, 1:]
        lengths = np.linalg.norm(axes, axis=1, keepdims=True)
        units = np.divide(axes, lengths, out=np.zeros_like(axes), where=lengths > 0)
        return np.abs(self.rotations[:, None] * (units @ normals.T))


def angles(quaternions: np.ndarray) -> np.ndarray:
    """Angles of rotations (w, x, y, z), shape (n, 4), as shape (n,) [rad]."""
    return 2 * np.arctan2(np.linalg.norm(quaternions[:, 1:], axis=1), np.abs(quaternions[:, 0]))
