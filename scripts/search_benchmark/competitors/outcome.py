"""What a competitor made of an instance within its budget."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """Its time and its answer, or how far it came."""

    seconds: float
    """To its proof; where it did not finish, a lower bound on that time."""

    finished: bool
    """Whether it has proven its answer."""

    rho: float = np.inf
    """Best found [N]."""

    lower_bound: float = 0.0
    """What it has proven of rho* [N]."""

    note: str = ""
    """Where a lower bound on the time comes from."""
