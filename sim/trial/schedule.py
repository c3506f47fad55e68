"""The load over time: the fingers take hold, then the wrench comes, then it stays.

With s the squeeze and a the load fraction, the wrench is s h + a (w - h) and the feed-forward force s p + a (f - p),
where p is the preload, h the wrench that it is held against, and f the answer to w. Every corner of this path
(nothing, p with h, f with w) balances, lies in the cones and respects the cap; these conditions are convex, so they
hold at every instant between. The squeeze grows gradually too: a sudden one shocks the contacts and slips by itself.

Fingers that adapt press along their normals (sim/trial/active.py), as on an object that still rests in its fixture:
h = -sum_i G_i p_i. That leans on no friction at all, so it is in the cones of every grasp, also of one that only
supports, where no internal force is. From no preload the contacts would have to form under a load at the edge of
their cones, where they chatter: 68 of 2,304 tests at 1.01 phi failed falsely, with the press none.
"""

import numpy as np

from planner.arrays import Floats
from sim.trial.protocol import ValidationProtocol


def steps(protocol: ValidationProtocol) -> int:
    """Number of time steps."""
    return round(protocol.duration / protocol.timestep)


def fractions(protocol: ValidationProtocol) -> Floats:
    """Squeeze s and load fraction a of every time step, shape (steps, 2)."""
    times = np.arange(1, steps(protocol) + 1) * protocol.timestep
    starts, lengths = [0.0, protocol.preload_time], [protocol.preload_time, protocol.ramp_time]
    return np.clip((times[:, None] - starts) / lengths, 0.0, 1.0)
