"""The force law of a finger: feed-forward plus a spring to its anchor, the total saturated at the cap.

    u_i = sat( f_i - K q_i - D dq_i/dt ),   sat(v) = v min(1, cap / |v|)

The spring holds the fingertip where friction should hold it; it cannot add capability, because the Euclidean
norm of the total never exceeds the cap.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats

TINY = 1e-300
"""Keeps 0 / 0 out of the saturation of a zero force [N]."""


def saturated(forces: Floats, caps: Floats) -> Floats:
    """Forces shortened to the cap where they exceed it.

    Args:
        forces: Shape (..., d) [N].
        caps: Largest norms, broadcastable to shape (...) [N].

    Returns:
        Shape (..., d) [N].
    """
    norms = np.sqrt(np.einsum("...d,...d->...", forces, forces))
    return forces * np.minimum(1.0, caps / np.maximum(norms, TINY))[..., None]


@dataclass(frozen=True, kw_only=True)
class FingerLaw:
    """Fingertips on springs: what a protocol says of its fingers."""

    tip_radii: tuple[float, ...] = (0.04, 0.01, 0.0025)
    """Radii of the fingertips, relative to the reach: the first that touches nothing but what was planned is taken.

    A tip in a corner narrower than itself touches both walls. Measured equal from 0.0025 to 0.4.
    """

    tip_mass: float = 0.01
    """Mass of a fingertip [kg]; measured equal from 0.003 to 0.03."""

    stiffness: float = 100.0
    """Stiffness K that holds a fingertip at its anchor [N/m]; 10 to 250 measured equal, 500 fails falsely."""

    damping_ratio: float = 0.7
    """Damping of that spring, relative to critical."""

    @property
    def damping(self) -> float:
        """Damping D of a fingertip, 2 zeta sqrt(K m) [N s/m]."""
        return 2 * self.damping_ratio * float((self.stiffness * self.tip_mass) ** 0.5)

    def forces(self, feed_forward: Floats, displacements: Floats, velocities: Floats, caps: Floats) -> Floats:
        """Force on every fingertip.

        Args:
            feed_forward: f, shape (..., 3) [N].
            displacements: q, of the fingertips from their anchors, shape (..., 3) [m].
            velocities: dq/dt, shape (..., 3) [m/s].
            caps: Largest norms, broadcastable to shape (...) [N].

        Returns:
            Shape (..., 3) [N].
        """
        return saturated(feed_forward - self.stiffness * displacements - self.damping * velocities, caps)
