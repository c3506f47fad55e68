"""One claim of a grasp file and what came of checking it."""

from dataclasses import dataclass
from enum import StrEnum


class Result(StrEnum):
    """What came of a check."""

    HOLDS = "holds"
    FAILS = "fails"
    NOT_CHECKED = "not checked"
    """What the claim is about is not there, or cannot be repeated; that says nothing against the claim."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """One claim and its result."""

    claim: str
    result: Result
    detail: str
    """How far off, or why it could not be checked."""

    @property
    def holds(self) -> bool:
        """Whether the claim was checked and is true."""
        return self.result is Result.HOLDS

    @property
    def fails(self) -> bool:
        """Whether the claim was checked and is false."""
        return self.result is Result.FAILS


def checked(claim: str, holds: bool, detail: str) -> Check:
    """A claim that could be checked."""
    return Check(claim=claim, result=Result.HOLDS if holds else Result.FAILS, detail=detail)


def not_checked(claim: str, why: str) -> Check:
    """A claim that could not be checked."""
    return Check(claim=claim, result=Result.NOT_CHECKED, detail=why)
