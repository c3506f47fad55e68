"""The active grasp: fingers that know each wrench and answer it, which is what rho means."""

import numpy as np

from planner.contacts import Contacts
from sim.feed_forward import FeedForward
from sim.protocol import ValidationProtocol
from sim.scene.units import Similarity
from sim.trial import Trial


def adaptive_trial(
    contacts: Contacts, units: Similarity, wrenches: np.ndarray, caps: np.ndarray, protocol: ValidationProtocol
) -> Trial:
    """A trial whose forces answer each wrench within its cap with the least friction utilisation.

    Where there is no wrench to answer the fingers go on squeezing.

    Args:
        contacts: The grasp in the body frame, SI, with the planned friction, of which only the ratios count.
        units: Map to the units of the experiment.
        wrenches: One per simulation, shape (simulations, 6) [N, N m].
        caps: One per simulation, relative to rho, shape (simulations,).
        protocol: Settings.
    """
    loads = units.wrenches(wrenches)
    feed_forward = FeedForward(units.contacts(contacts), np.zeros(3))
    preload = protocol.preload * feed_forward.internal_force(1.0)
    return Trial(
        wrenches=loads,
        caps=caps,
        preloads=caps[:, None, None] * preload,
        forces=np.array(
            [
                feed_forward.forces(load, cap) if load.any() else cap * preload
                for load, cap in zip(loads, caps, strict=True)
            ]
        ),
    )
