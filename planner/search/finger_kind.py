"""Fingers that differ: in what they may touch, and in how strong they are."""

from dataclasses import dataclass
from math import inf

from planner.errors import CandidateError


@dataclass(frozen=True, kw_only=True)
class FingerKind:
    """Interchangeable fingers and their share of a problem's candidates.

    Raises:
        CandidateError: When there are fewer candidates than fingers, or the strength is not positive.
    """

    fingers: int
    """How many fingers of this kind there are, at least 1."""

    candidates: int
    """How many of the problem's candidates are for this kind; they follow each other."""

    strength: float = 1.0
    """s: such a finger can push s times the force level phi, |f_i| <= s phi."""

    def __post_init__(self) -> None:
        if not 1 <= self.fingers <= self.candidates:
            raise CandidateError(
                f"{self.fingers} fingers of one kind but {self.candidates} candidates for them; "
                "ask for more candidates or looser limits"
            )
        if not 0 < self.strength < inf:
            raise CandidateError(f"a finger's strength is {self.strength}; it must be positive and finite")
