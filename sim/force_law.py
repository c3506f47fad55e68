"""The force law of a finger: feed-forward plus a spring to its anchor, the total saturated at the cap.

    u_i = sat( f_i - K q_i - D dq_i/dt ),   sat(v) = v min(1, cap / |v|)

The spring holds the fingertip where friction should hold it; it cannot add capability, because the Euclidean
norm of the total never exceeds the cap.
"""

import numpy as np

TINY = 1e-300
"""Keeps 0 / 0 out of the saturation of a zero force [N]."""


def saturated(forces: np.ndarray, caps: np.ndarray) -> np.ndarray:
    """Forces shortened to the cap where they exceed it.

    Args:
        forces: Shape (..., d) [N].
        caps: Largest norms, broadcastable to shape (...) [N].

    Returns:
        Shape (..., d) [N].
    """
    norms = np.sqrt(np.einsum("...d,...d->...", forces, forces))
    return forces * np.minimum(1.0, caps / np.maximum(norms, TINY))[..., None]


def finger_forces(
    feed_forward: np.ndarray,
    displacements: np.ndarray,
    velocities: np.ndarray,
    caps: np.ndarray,
    stiffness: float,
    damping: float,
) -> np.ndarray:
    """Force on every fingertip.

    Args:
        feed_forward: f, shape (..., 3) [N].
        displacements: q, of the fingertips from their anchors, shape (..., 3) [m].
        velocities: dq/dt, shape (..., 3) [m/s].
        caps: Largest norms, broadcastable to shape (...) [N].
        stiffness: K [N/m].
        damping: D [N s/m].

    Returns:
        Shape (..., 3) [N].
    """
    return saturated(feed_forward - stiffness * displacements - damping * velocities, caps)
