"""The load over time: the fingers squeeze, then the wrench comes, then it stays.

With s the squeeze and a the load fraction, the wrench is a w and the feed-forward force s p + a (f - p), where
p is the preload and f the answer to w. Every corner of this path (nothing, p, f) balances, lies in the cones and
respects the cap; these conditions are convex, so they hold at every instant between. The squeeze grows
gradually too: a sudden one shocks the contacts and slips by itself.
"""

import numpy as np

from sim.protocol import ValidationProtocol


def steps(protocol: ValidationProtocol) -> int:
    """Number of time steps."""
    return round(protocol.duration / protocol.timestep)


def fractions(protocol: ValidationProtocol) -> np.ndarray:
    """Squeeze s and load fraction a of every time step, shape (steps, 2)."""
    times = np.arange(1, steps(protocol) + 1) * protocol.timestep
    starts, lengths = [0.0, protocol.preload_time], [protocol.preload_time, protocol.ramp_time]
    return np.clip((times[:, None] - starts) / lengths, 0.0, 1.0)
