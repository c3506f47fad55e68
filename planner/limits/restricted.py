"""The candidates that any finger may use: those that no restriction removes."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from planner.arrays import Mask
from planner.candidates.candidates import Candidates
from planner.errors import CandidateError
from planner.limits.approach import approachable
from planner.limits.fit import require_fit
from planner.limits.geoms import off_excluded_geoms
from planner.limits.keep_out import outside_boxes
from planner.limits.limits import Limits
from planner.limits.table import above_table
from planner.objects.graspable import Graspable

Restriction = Callable[[Graspable, Candidates, Limits], Mask]
"""Whether each candidate is allowed, shape (n,); all are where the limits say nothing of it."""

RESTRICTIONS: dict[str, Restriction] = {
    "exclude_geoms": off_excluded_geoms,
    "keep_out": outside_boxes,
    "table": above_table,
    "approach": approachable,
}
"""By their keys in a limits file, in the order they are asked, the slowest last.

To add one: write its function in a file of its own, its table in `limits.py`, and name it here.
"""


@dataclass(frozen=True, eq=False, kw_only=True)
class Restricted:
    """The allowed candidates, and why the others are not."""

    candidates: Candidates

    removed: dict[str, int]
    """How many candidates each restriction removed; each counts for the first that forbids it."""


def restricted(rigid_object: Graspable, candidates: Candidates, limits: Limits) -> Restricted:
    """Leave out the candidates that no finger may use, in their order.

    Args:
        rigid_object: The object.
        candidates: On its surface.
        limits: What the fingers can do.

    Raises:
        LimitsError: If the limits do not fit the object.
        CandidateError: If none is left.
    """
    require_fit(limits, rigid_object)
    left, removed = candidates, dict.fromkeys(RESTRICTIONS, 0)
    for name, allows in RESTRICTIONS.items():
        allowed = np.flatnonzero(allows(rigid_object, left, limits))
        removed[name] = len(left) - len(allowed)
        left = left.kept(allowed)
        if not len(left):
            raise CandidateError(
                f"{name} leaves none of the {len(candidates)} candidates (removed: {removals(removed)}); loosen the "
                "limits, or ask for more candidates"
            )
    limited = left if limits == Limits() else left.chosen(limited=True)
    return Restricted(candidates=limited, removed=removed)


def removals(removed: dict[str, int]) -> str:
    """In words, the restrictions that removed candidates and how many."""
    return ", ".join(f"{count} by {name}" for name, count in removed.items() if count)
