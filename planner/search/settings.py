"""What a certified search is asked for."""

from dataclasses import dataclass

import numpy as np

from planner.errors import SettingError


@dataclass(frozen=True, kw_only=True)
class SearchSettings:
    """Gap, limits, and which grasps to return.

    Raises:
        SettingError: When a setting is out of range.
    """

    gap: float = 1e-3
    """Stop when rho / lower_bound - 1 is proven to be at most this."""

    time_limit: float = np.inf
    """Seconds after which the search stops with the gap it has."""

    keep: int = 1
    """How many grasps to return: the k best, or with `within` at most so many."""

    within: float | None = None
    """Return all grasps whose rho exceeds the best by at most this, relatively: ties and near-ties, none missing."""

    apart: float = 0.0
    """With several grasps to return: each is the best of those that have a contact at least this far [m] from every
    contact of each grasp before it."""

    seed: int = 0
    """Seed of the starts of the local search; the proof does not depend on it."""

    def __post_init__(self) -> None:
        if not 0 <= self.gap < np.inf:
            raise SettingError(f"the gap is {self.gap}; it must be 0 or more, for example 1e-3")
        if not self.time_limit >= 0:
            raise SettingError(f"the time limit is {self.time_limit} s; it must be 0 or more")
        if self.seed < 0:
            raise SettingError(f"the seed is {self.seed}; it must be 0 or more")
        if self.keep < 1:
            raise SettingError(f"{self.keep} grasps are asked for; ask for at least 1")
        if self.within is not None and not 0 <= self.within < np.inf:
            raise SettingError(f"the tolerance is {self.within}; it must be 0 or more, for example 0.01")
        if not 0 <= self.apart < np.inf:
            raise SettingError(f"the distance between grasps is {self.apart} m; it must be 0 or more")
