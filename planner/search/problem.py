"""Problem (4): choose m of n candidate contacts so that the largest force W_R asks for is smallest.

rho* = min over m-subsets N of max over vertices w_j of phi_N(w_j)
"""

from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from planner.contacts import Contacts, contact_frames, grasp_maps, wrench_dimension
from planner.errors import CandidateError, TaskError

MOST_FINGERS = 8


@dataclass(frozen=True, eq=False, kw_only=True)
class SearchProblem:
    """Candidates, number of fingers and required external force set.

    Raises:
        CandidateError: When the number of fingers does not fit the candidates.
        TaskError: When W_R is empty, not finite, all zero, or of the wrong dimension.
    """

    contacts: Contacts
    """The n candidate contacts, in the body frame."""

    fingers: int
    """Number of contacts to choose, m."""

    reference_point: np.ndarray
    """p_o, about which moments are taken, shape (d,) [m]."""

    wrenches: np.ndarray
    """Vertices of W_R, shape (l, D) [N, N m]."""

    def __post_init__(self) -> None:
        if not 1 <= self.fingers <= MOST_FINGERS:
            raise CandidateError(f"{self.fingers} fingers; allowed are 1 to {MOST_FINGERS}")
        if self.fingers > len(self.contacts):
            raise CandidateError(
                f"{self.fingers} fingers but only {len(self.contacts)} candidate contacts; "
                "ask for more candidates or fewer fingers"
            )
        size = wrench_dimension(self.contacts.dimension)
        if self.wrenches.ndim != 2 or self.wrenches.shape[1] != size or not len(self.wrenches):
            raise TaskError(f"the wrenches have shape {self.wrenches.shape}; expected (at least 1, {size})")
        if not np.isfinite(self.wrenches).all():
            raise TaskError("the required external force set holds a value that is not finite")
        if not self.wrenches.any():
            raise TaskError("the required external force set holds only the zero wrench; it asks for no force")

    @property
    def subsets(self) -> int:
        """Number of m-subsets."""
        return comb(len(self.contacts), self.fingers)

    @cached_property
    def length(self) -> float:
        """Largest distance of a candidate from p_o [m]: makes moments comparable with forces."""
        return float(np.linalg.norm(self.contacts.points - self.reference_point, axis=1).max()) or 1.0

    @cached_property
    def maps(self) -> np.ndarray:
        """Grasp maps from contact frames, G_i R_i, shape (n, D, d)."""
        return grasp_maps(self.contacts.points, self.reference_point) @ self.frames

    @cached_property
    def frames(self) -> np.ndarray:
        """Contact frames R_i, shape (n, d, d)."""
        return contact_frames(self.contacts.normals)

    @cached_property
    def force_ceiling(self) -> float:
        """Ten thousand times the largest wrench of W_R [N]: a grasp that needs more is called infeasible.

        Far above any finger, and far below what the accuracy of infeasibility certificates can resolve.
        """
        scale = np.ones(self.wrenches.shape[1])
        scale[self.contacts.dimension :] /= self.length
        return 1e4 * float(np.abs(self.wrenches * scale).max())
