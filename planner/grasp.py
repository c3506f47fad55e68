"""A planned grasp with everything needed to check it. Frame: the object's body frame B, SI."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from planner.contacts import Contacts
from planner.objects.given_mass import NOTHING_GIVEN, GivenMass
from planner.search.result import Status, relative_gap
from planner.task import Task


@dataclass(frozen=True, kw_only=True)
class SearchRecord:
    """How the grasp was found."""

    method: str
    fingers: int
    candidates: int
    subsets: int
    nodes: int
    socp_solves: int
    cuts: int
    seconds: float
    seed: int
    gap: float
    """Relative gap that was asked for."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Certificate:
    """Why no m-subset of the candidates needs less than the lower bound.

    Every row lambda proves 1 / rho_N <= sum_{i in N} h_i(lambda) / c(lambda), with h_i the support function of
    G_i (K_i ∩ B) and c(lambda) = max_j -lambda . w_j; together they prove the bound for all subsets. For two
    fingers in space the moment about the line through the pair counts as one more row.
    """

    candidates: Contacts
    """All n candidate contacts."""

    cuts: np.ndarray
    """Directions lambda, shape (cuts, D)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Grasp:
    """The best grasp found, its forces, its proven bound and where it came from."""

    file: Path
    """The file of the object: MJCF, or a planar outline."""

    sha256: str
    """Digest of the object's files."""

    body: str
    """The body whose frame is B."""

    mass: float
    """Mass of the object [kg]."""

    task: Task
    """W_R."""

    contacts: Contacts
    """The chosen contacts, m of them; none if the status is infeasible or no grasp was found."""

    geoms: tuple[str, ...]
    """Collision geom each contact lies on."""

    candidates: np.ndarray
    """Number of each contact among the candidates, shape (m,)."""

    lower_bound: float
    """Proven: no subset of the candidates has a smaller rho [N]."""

    status: Status
    """How the search ended."""

    phi: np.ndarray
    """Least largest fingertip force for each wrench, shape (l,) [N]; empty without contacts."""

    forces: np.ndarray
    """Contact forces that balance each wrench, shape (l, m, d) [N]."""

    search: SearchRecord

    certificate: Certificate

    packages: dict[str, str]
    """Versions of rhograsp and of the packages that made it."""

    given: GivenMass = NOTHING_GIVEN
    """Mass properties that the user gave in place of those of the object's file."""

    @property
    def found(self) -> bool:
        """Whether there is a grasp at all."""
        return len(self.contacts) > 0

    @property
    def rho(self) -> float:
        """Largest fingertip force the grasp needs for any wrench of W_R [N]; infinite without a grasp."""
        return float(self.phi.max(initial=-np.inf)) if self.found else np.inf

    @property
    def critical_wrench(self) -> int:
        """Which wrench needs rho.

        Raises:
            ValueError: Without a grasp.
        """
        return int(self.phi.argmax())

    @property
    def gap(self) -> float:
        """rho / lower_bound - 1; infinite without a grasp."""
        return relative_gap(self.rho, self.lower_bound)
