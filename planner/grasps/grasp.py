"""A planned grasp with everything needed to check it. Frame: the object's body frame B, SI."""

from dataclasses import dataclass
from math import comb, prod
from pathlib import Path

import numpy as np

from planner.arrays import Floats, Indices
from planner.candidates.candidates import CandidateChoice
from planner.contacts import Contacts
from planner.errors import CandidateError
from planner.objects.object_source import ObjectSource
from planner.search.finger_kind import FingerKind
from planner.search.result import Status, relative_gap
from planner.task import Task


@dataclass(frozen=True, kw_only=True)
class TraceLine:
    """One line of the search log."""

    seconds: float
    """Since the search began [s]."""

    nodes: int
    """Nodes of the search tree that were split."""

    open: int
    """Nodes that were left to split."""

    lower_bound: float
    """Proven by then: no subset of the candidates has a smaller rho [N]."""

    incumbent: float | None
    """Smallest rho found by then [N]; None before the first."""

    socp_solves: int
    """Second-order cone programs solved."""

    cuts: int
    """Cuts in the table."""


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
    trace: tuple[TraceLine, ...] = ()
    """The search log, oldest line first; a long one is thinned. Empty where it was not recorded."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Certificate:
    """Why no m-subset of the candidates needs less than the lower bound.

    Every row lambda proves 1 / rho_N <= sum_{i in N} s_i h_i(lambda) / c(lambda), with s_i the strength of the finger
    at candidate i, h_i the support function of G_i (K_i ∩ B) and c(lambda) = max_j -lambda . w_j; together they prove
    the bound for all subsets N that have the right number of fingers of each kind and keep spacing and span. For two
    fingers in space, of which two may be hard, the moment about the line through the pair counts as one more row.

    Raises:
        CandidateError: When the kinds do not add up to the candidates, or no distance fits spacing and span.
    """

    candidates: Contacts
    """All n candidate contacts; a point that fingers of several kinds may touch is listed for each of them."""

    cuts: Floats
    """Directions lambda, shape (cuts, D)."""

    kinds: tuple[FingerKind, ...] = ()
    """Kinds of fingers, whose candidates follow each other; empty: all fingers are alike."""

    spacing: float = 0.0
    """Least distance between two contacts [m]; where there are several kinds it is positive, so that fingers never
    share a point."""

    span: float = np.inf
    """Greatest distance between two contacts [m]."""

    def __post_init__(self) -> None:
        listed = sum(kind.candidates for kind in self.kinds)
        if self.kinds and listed != len(self.candidates):
            raise CandidateError(f"kinds of fingers for {listed} candidates, of which there are {len(self.candidates)}")
        if not 0 <= self.spacing < np.inf or not self.spacing <= self.span:
            raise CandidateError(
                f"spacing {self.spacing} m and span {self.span} m; the least distance between two contacts must be 0 "
                "or more and at most the greatest"
            )

    @property
    def kind(self) -> Indices:
        """Which kind of finger each candidate is for, shape (n,)."""
        if not self.kinds:
            return np.zeros(len(self.candidates), dtype=np.int64)
        return np.repeat(np.arange(len(self.kinds)), [kind.candidates for kind in self.kinds])

    @property
    def strengths(self) -> Floats:
        """s_i of the finger at each candidate, shape (n,)."""
        return np.array([kind.strength for kind in self.kinds] or [1.0])[self.kind]

    def subsets(self, fingers: int) -> int:
        """Number of subsets of so many candidates with the right number of each kind, whatever their distances."""
        if not self.kinds:
            return comb(len(self.candidates), fingers)
        return prod(comb(kind.candidates, kind.fingers) for kind in self.kinds)


@dataclass(frozen=True, kw_only=True)
class ProofCheck:
    """How much of the proof the independent code had checked when the grasp was planned."""

    share: float
    """Of the subsets, 0 to 1: less than 1 where checking all would have taken too long."""

    seconds: float
    """For which it was checked [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Grasp:
    """The best grasp found, its forces, its proven bound and where it came from."""

    source: ObjectSource
    """The file of the object, MJCF or a planar outline, and how it is read."""

    sha256: str
    """Digest of the object's files."""

    body: str
    """The body whose frame is B."""

    mass: float
    """Mass of the object [kg]."""

    task: Task
    """W_R."""

    contacts: Contacts
    """The chosen contacts, m of them, and the strength of their fingers; none if the status is infeasible or no grasp
    was found."""

    geoms: tuple[str, ...]
    """Collision geom each contact lies on."""

    chosen: Indices
    """Number of each contact among the candidates, shape (m,)."""

    lower_bound: float
    """Proven: no subset of the candidates has a smaller rho [N]."""

    status: Status
    """How the search ended."""

    phi: Floats
    """Least force level for each wrench, shape (l,) [N]; empty without contacts."""

    forces: Floats
    """Contact forces that balance each wrench, shape (l, m, d) [N]."""

    torques: Floats
    """Torques about the inward normals that do so beside them, shape (l, m) [N m]; zero for hard fingers."""

    search: SearchRecord

    certificate: Certificate

    packages: dict[str, str]
    """Versions of rhograsp and of the packages that made it."""

    proof_check: ProofCheck | None = None
    """What was checked of the certificate; None where it is not known, or no bound is claimed."""

    center_of_mass: Floats | None = None
    """Of the object, shape (d,) [m]; None where it is not recorded."""

    candidate_choice: CandidateChoice | None = None
    """How the candidates were chosen, where it is known."""

    command: str | None = None
    """The command line that made the grasp, as a shell takes it; None where it was made from Python."""

    @property
    def file(self) -> Path:
        """The file of the object: MJCF, or a planar outline."""
        return self.source.file

    @property
    def found(self) -> bool:
        """Whether there is a grasp at all."""
        return len(self.contacts) > 0

    @property
    def rho(self) -> float:
        """The force level the grasp needs for any wrench of W_R [N]; infinite without a grasp.

        Finger i must be able to push with s_i rho, s_i its strength: usually 1, and rho the largest fingertip force.
        """
        return float(self.phi.max(initial=-np.inf)) if self.found else np.inf

    @property
    def grip(self) -> float:
        """The largest normal component of a contact force under any wrench of W_R [N]; infinite without a grasp."""
        if not self.found:
            return np.inf
        return float(np.einsum("lmd,md->lm", self.forces, self.contacts.normals).max())

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
