"""Problem (4): choose m of n candidate contacts so that the largest force W_R asks for is smallest.

rho* = min over m-subsets N of max over vertices w_j of phi_N(w_j)
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import comb, prod

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.contact_models.contact_model import ContactModel
from planner.contact_models.models import model_of
from planner.contacts import Contacts, contact_frames, reach, wrench_dimension, wrench_scale
from planner.errors import CandidateError, TaskError
from planner.search.finger_kind import FingerKind

MOST_FINGERS = 8

MOST_CASES = 50_000
"""Inner problems solved for one subset, a few seconds."""

SAME_POINT = 1e-9
"""Contacts closer than this, relative to the object, are one point."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SearchProblem:
    """Candidates, number of fingers and required external force set.

    Fingers may differ in kind: which candidates they may touch, and how strong they are. A point that fingers of
    several kinds may touch is then listed once for each of them.

    Raises:
        CandidateError: When the number of fingers does not fit the candidates, or a limit is out of range.
        TaskError: When W_R is empty, not finite, all zero, or of the wrong dimension.
    """

    contacts: Contacts
    """The n candidate contacts, in the body frame."""

    fingers: int
    """Number of contacts to choose, m."""

    reference_point: Floats
    """p_o, about which moments are taken, shape (d,) [m]."""

    wrenches: Floats
    """Vertices of W_R, shape (l, D) [N, N m]."""

    kinds: tuple[FingerKind, ...] = ()
    """Kinds of fingers, whose candidates follow each other in `contacts`; empty: all fingers are alike."""

    spacing: float = 0.0
    """Least distance between two chosen contacts [m]."""

    span: float = np.inf
    """Largest distance between two chosen contacts [m]."""

    position_error: float = 0.0
    """How far a finger may miss its contact along the surface [m]. With it, rho is the worst over all combinations of
    the contact itself and the shifts of this length (in space along two perpendicular tangents, forth and back; in the
    plane along the edge), each finger on its own; the facet is taken as flat."""

    def __post_init__(self) -> None:
        require_finger_number(self.fingers)
        if self.fingers > len(self.contacts):
            raise CandidateError(
                f"{self.fingers} fingers but only {len(self.contacts)} candidate contacts; "
                "ask for more candidates or fewer fingers"
            )
        self._check_limits()
        size = wrench_dimension(self.contacts.dimension)
        if self.wrenches.ndim != 2 or self.wrenches.shape[1] != size or not len(self.wrenches):
            raise TaskError(f"the wrenches have shape {self.wrenches.shape}; expected (at least 1, {size})")
        if not np.isfinite(self.wrenches).all():
            raise TaskError("the required external force set holds a value that is not finite")
        if not self.wrenches.any():
            raise TaskError("the required external force set holds only the zero wrench; it asks for no force")

    def _check_limits(self) -> None:
        if self.contacts.strength is not None:
            raise CandidateError(
                "candidates have no strength of their own; say how strong their fingers are in `kinds`"
            )
        if not 0 <= self.spacing < np.inf or not self.span > 0 or self.spacing > self.span:
            raise CandidateError(
                f"spacing {self.spacing} m and span {self.span} m; the least distance between two contacts must be 0 "
                "or more and at most the largest"
            )
        if self.kinds and (
            sum(kind.fingers for kind in self.kinds) != self.fingers
            or sum(kind.candidates for kind in self.kinds) != len(self.contacts)
        ):
            raise CandidateError(
                f"the kinds of fingers {self.kinds} do not add up to {self.fingers} fingers and "
                f"{len(self.contacts)} candidates"
            )
        if not 0 <= self.position_error < np.inf:
            raise CandidateError(f"the position error is {self.position_error} m; it must be 0 or more")
        if self.position_error and self.cases > MOST_CASES:
            raise CandidateError(
                f"with a position error, {self.fingers} fingers and {len(self.wrenches)} wrenches ask for "
                f"{self.cases:,} inner problems for each grasp; at most {MOST_CASES:,} are solved: use fewer of either"
            )

    @property
    def subsets(self) -> int:
        """Number of m-subsets with the right number of fingers of each kind."""
        return prod(comb(kind.candidates, kind.fingers) for kind in self.all_kinds)

    @property
    def all_kinds(self) -> tuple[FingerKind, ...]:
        """Kinds of fingers, at least one."""
        return self.kinds or (FingerKind(fingers=self.fingers, candidates=len(self.contacts)),)

    @property
    def kind_of_finger(self) -> Indices:
        """Which kind each finger is of, shape (m,)."""
        return np.repeat(np.arange(len(self.all_kinds)), [kind.fingers for kind in self.all_kinds])

    @cached_property
    def kind(self) -> Indices:
        """Which kind of finger each candidate is for, shape (n,)."""
        return np.repeat(np.arange(len(self.all_kinds)), [kind.candidates for kind in self.all_kinds])

    @cached_property
    def strengths(self) -> Floats:
        """s_i: the finger at candidate i can push s_i times the force level phi, |f_i| <= s_i phi; shape (n,)."""
        return np.repeat([kind.strength for kind in self.all_kinds], [kind.candidates for kind in self.all_kinds])

    @cached_property
    def fingertips(self) -> Contacts:
        """The candidates with the strengths of their fingers."""
        return replace(self.contacts, strength=self.strengths)

    @property
    def model(self) -> ContactModel:
        """How fingers touch."""
        return model_of(self.contacts)

    @property
    def least_distance(self) -> float:
        """Least distance between two chosen contacts [m]: fingers of different kinds never share a point."""
        return max(self.spacing, SAME_POINT * self.length) if len(self.kinds) > 1 else self.spacing

    @property
    def pairs_are_limited(self) -> bool:
        """Whether some pairs of candidates are too close or too far apart."""
        return self.least_distance > 0 or self.span < np.inf

    @property
    def is_the_papers(self) -> bool:
        """Whether all fingers are alike, hard, meet their contacts, and may be at any distance from each other."""
        alike = not self.kinds and not self.contacts.torsions.any()
        return alike and not self.pairs_are_limited and not self.position_error

    def admits(self, subset: Indices) -> bool:
        """Whether a subset of candidates, shape (m,), has the right kinds of fingers, spacing and span."""
        of_kind = np.bincount(self.kind[subset], minlength=len(self.all_kinds))
        if any(count != kind.fingers for count, kind in zip(of_kind, self.all_kinds, strict=True)):
            return False
        return all(bool(self.partners(subset[:k])[subset[k]]) for k in range(1, len(subset)))

    def among(self, chosen: Indices) -> "SearchProblem":
        """The problem with only some of its candidates, ascending indices of shape (chosen,)."""
        left = np.bincount(self.kind[chosen], minlength=len(self.all_kinds))
        kinds = tuple(replace(kind, candidates=int(count)) for kind, count in zip(self.kinds, left, strict=False))
        return replace(self, contacts=self.contacts.subset(chosen), kinds=kinds)

    def partners(self, chosen: Indices) -> Mask:
        """Which candidates keep spacing and span to all the chosen ones, shape (n,); the chosen are not among them."""
        allowed = np.ones(len(self.contacts), dtype=bool)
        allowed[chosen] = False
        if self.pairs_are_limited:
            for point in self.contacts.points[chosen]:
                distances = np.linalg.norm(self.contacts.points - point, axis=1)
                allowed &= (distances >= self.least_distance) & (distances <= self.span)
        return allowed

    @cached_property
    def length(self) -> float:
        """Largest distance of a candidate from p_o [m]: makes moments comparable with forces."""
        return reach(self.contacts.points, self.reference_point)

    @cached_property
    def maps(self) -> Floats:
        """G_i from the components of each candidate's contact to wrenches, shape (n, D, k), strengths in them."""
        return self.model.maps(self.fingertips, self.reference_point)

    @cached_property
    def shifted_maps(self) -> Floats:
        """`maps` of every place where a finger may land, the contact itself first, shape (shifts, n, D, k)."""
        if not self.position_error:
            return self.maps[None]
        tangents = contact_frames(self.contacts.normals)[:, :, 1:].transpose(2, 0, 1)  # shape (d - 1, n, d)
        offsets = self.position_error * np.concatenate([0 * tangents[:1], tangents, -tangents])
        landed = [replace(self.fingertips, points=self.contacts.points + offset) for offset in offsets]
        return np.stack([self.model.maps(contacts, self.reference_point) for contacts in landed])

    @property
    def cases(self) -> int:
        """Inner problems that decide rho of a subset: vertices of W_R times combinations of shifts."""
        return len(self.wrenches) * len(self.shifted_maps) ** self.fingers

    @cached_property
    def force_ceiling(self) -> float:
        """Ten thousand times the largest wrench of W_R [N]: a grasp that needs more is called infeasible.

        Far above any finger, and far below what the accuracy of infeasibility certificates can resolve.
        """
        return 1e4 * float(np.abs(self.wrenches * wrench_scale(self.contacts.dimension, self.length)).max())


def require_finger_number(fingers: int) -> None:
    """Refuse numbers of fingers that no search takes.

    Raises:
        CandidateError: If there are fewer than one or more than MOST_FINGERS.
    """
    if not 1 <= fingers <= MOST_FINGERS:
        raise CandidateError(f"{fingers} fingers; allowed are 1 to {MOST_FINGERS}")
