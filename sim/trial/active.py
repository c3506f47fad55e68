"""The active grasp: fingers that know each wrench and answer it, which is what rho means."""

import numpy as np

from planner.contacts import Contacts, grasp_maps
from sim.scene.units import Units
from sim.trial.feed_forward import FeedForward
from sim.trial.protocol import ValidationProtocol
from sim.trial.trial import Trial


def active_trial(
    contacts: Contacts, units: Units, wrenches: np.ndarray, caps: np.ndarray, protocol: ValidationProtocol
) -> Trial:
    """A trial whose forces answer each wrench within its cap with the least friction utilisation.

    Before it comes they press along their normals, each with its strength, against the wrench that balances them;
    where there is no wrench to answer they squeeze with an internal force.

    Args:
        contacts: The grasp in the body frame, SI, with the planned friction, of which only ratios count; see
            `FeedForward`.
        units: Map to the units of the experiment.
        wrenches: One per simulation, shape (simulations, 6) [N, N m].
        caps: One per simulation, relative to rho, shape (simulations,).
        protocol: Settings.
    """
    loads = units.wrenches(wrenches)
    touching = units.contacts(contacts)
    feed_forward = FeedForward(touching, np.zeros(3))
    press = protocol.preload * touching.strengths[:, None] * touching.normals
    held_against = -np.einsum("iDd,id->D", grasp_maps(touching.points, np.zeros(3)), press)
    pushes = [
        feed_forward.answer(load, cap) if load.any() else feed_forward.squeeze(protocol.preload * cap)
        for load, cap in zip(loads, caps, strict=True)
    ]
    return Trial(
        wrenches=loads,
        caps=caps,
        preloads=caps[:, None, None] * press,
        preload_wrenches=caps[:, None] * held_against,
        forces=np.array([push.forces for push in pushes]),
        torques=np.array([push.torques for push in pushes]),
    )
