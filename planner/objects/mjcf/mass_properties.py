"""Mass, centre of mass and inertia of several rigidly joined bodies."""

from typing import NamedTuple

import numpy as np

from planner.arrays import Floats
from planner.objects.pose import Pose


class MassProperties(NamedTuple):
    """Of a rigid object, in its body frame B."""

    mass: float
    """[kg]"""

    center_of_mass: Floats
    """Shape (3,) [m]; the origin where the mass is zero."""

    inertia: Floats
    """About the centre of mass, in the axes of B, shape (3, 3) [kg m^2]."""


def combined(masses: Floats, frames: list[Pose], principal_inertias: Floats) -> MassProperties:
    """Sum of bodies, each given in its principal frame.

        m = sum m_k,   c = sum m_k c_k / m,   I = sum R_k I_k R_k^T + m_k (|d_k|^2 1 - d_k d_k^T),   d_k = c_k - c

    Args:
        masses: m_k, shape (bodies,) [kg].
        frames: Principal frames in B; their origins are the centres of mass c_k.
        principal_inertias: Diagonals of I_k, shape (bodies, 3) [kg m^2].
    """
    mass = float(masses.sum())
    centers = np.array([frame.position for frame in frames])
    center = masses @ centers / mass if mass > 0 else np.zeros(3)
    inertia = np.zeros((3, 3))
    for body_mass, frame, principal in zip(masses, frames, principal_inertias, strict=True):
        arm = frame.position - center
        inertia += frame.rotation @ np.diag(principal) @ frame.rotation.T
        inertia += body_mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return MassProperties(mass, center, inertia)
