"""What a search returns: its best grasp, a proven bound, and the cuts that prove it."""

from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from planner.arrays import Floats
from planner.search.evaluation import Evaluation
from planner.search.problem import SearchProblem


class Status(StrEnum):
    """How a search ended."""

    OPTIMAL = "optimal"
    """The gap is proven to be at most the one asked for."""

    ALTERNATIVE = "alternative"
    """One of several grasps asked for, not the best: its gap to the proven bound is true, and larger than asked."""

    INFEASIBLE = "infeasible"
    """Proven: no subset resists W_R with forces below the problem's force ceiling."""

    UNRESOLVED = "unresolved"
    """Everything was examined, but the solver's accuracy left a subset whose bound is weaker than asked."""

    HEURISTIC = "heuristic"
    """The best of a search that leaves candidates out; nothing is proven about those."""

    TIME_LIMIT = "time_limit"
    """Out of time; the bound and the gap are true, and open."""

    INTERRUPTED = "interrupted"
    """Stopped by the user; the bound and the gap are true, and open."""


@dataclass(frozen=True, kw_only=True)
class Progress:
    """One line of a search log."""

    seconds: float
    nodes: int
    open: int
    lower_bound: float
    """Proven lower bound on rho* [N]."""
    incumbent: float
    """Best rho found [N]; infinite before the first."""
    socp_solves: int
    cuts: int

    @property
    def gap(self) -> float:
        """incumbent / lower_bound - 1."""
        return relative_gap(self.incumbent, self.lower_bound)


@dataclass(frozen=True, eq=False, kw_only=True)
class SearchResult:
    """The outcome of a search and its proof."""

    problem: SearchProblem

    method: str
    """Name of the search."""

    status: Status

    grasps: tuple[Evaluation, ...]
    """Grasps found and asked for, best first; empty if none was found."""

    lower_bound: float
    """No m-subset of the candidates has a smaller rho [N]; at most the problem's force ceiling and every rho found."""

    cuts: Floats
    """Cuts that prove the lower bound, shape (cuts, D), scaled so that max_j -lambda . w_j = 1."""

    stated: dict[str, float] = field(default_factory=dict)
    """What every subset must keep to, as the certificate states it; empty where nothing is asked."""

    trace: tuple[Progress, ...]
    """The search log, oldest first; the last line is the end state."""

    @property
    def incumbent(self) -> Evaluation | None:
        """The best grasp found, if any."""
        return self.grasps[0] if self.grasps else None

    @property
    def rho(self) -> float:
        """Largest fingertip force the best grasp needs [N]; infinite without a grasp."""
        return self.incumbent.rho if self.incumbent else np.inf

    @property
    def gap(self) -> float:
        """rho / lower_bound - 1."""
        return relative_gap(self.rho, self.lower_bound)

    def with_grasps(self, grasps: tuple[Evaluation, ...]) -> "SearchResult":
        """The same proof beside other grasps; where the solver finds one of them to need less, so does the bound."""
        least = min((grasp.rho for grasp in grasps), default=np.inf)
        return replace(self, grasps=grasps, lower_bound=min(self.lower_bound, least))


def relative_gap(rho: float, lower_bound: float) -> float:
    """rho / lower_bound - 1; infinite before both are known, never below zero."""
    if not np.isfinite(rho) or lower_bound <= 0:
        return np.inf
    return max(0.0, rho / lower_bound - 1)
