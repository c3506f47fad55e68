"""From fingers that differ to the search's kinds.

Fingers that may use the same candidates, equally strong and with equal torsional friction, are alike.

A candidate that several kinds may use is listed once for each of them.
"""

from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Indices
from planner.candidates.candidates import Candidates
from planner.errors import LimitsError
from planner.limits.fingers import finger_masks, require_finger_count
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable
from planner.search.finger_kind import FingerKind
from planner.search.problem import require_finger_number


@dataclass(frozen=True, eq=False, kw_only=True)
class Kinds:
    """The kinds of fingers, their candidates one after another, and which finger is of which kind."""

    kinds: tuple[FingerKind, ...]
    """Empty where all fingers are alike and of strength 1."""

    candidates: Candidates
    """Those of the first kind, then those of the second, ..."""

    of_finger: Indices
    """Kind of each finger, shape (fingers,)."""

    def in_finger_order(self, subset: Indices) -> Indices:
        """The contact of each finger, shape (fingers,), as a place in a subset.

        Args:
            subset: One candidate for each finger in any order, shape (fingers,). Fingers of one kind take theirs in
                the order of the candidates.
        """
        places = np.empty(len(subset), dtype=np.int64)
        places[np.argsort(self.of_finger, kind="stable")] = np.argsort(subset)
        return places


def finger_kinds(rigid_object: Graspable, candidates: Candidates, fingers: int, limits: Limits) -> Kinds:
    """Group the fingers.

    Args:
        rigid_object: The object.
        candidates: On its surface, those that `restricted` leaves.
        fingers: How many.
        limits: What they can do.

    Raises:
        LimitsError: If there are tables [[finger]], and not one for every finger; or if no two candidates keep
            spacing and span.
        CandidateError: If a kind has fewer candidates than fingers, or the number of fingers is out of range.
    """
    require_finger_number(fingers)
    require_finger_count(limits, fingers)
    require_room(candidates, fingers, limits)
    alike = np.zeros(fingers, dtype=np.int64)
    if not limits.fingers:
        return Kinds(kinds=(), candidates=candidates, of_finger=alike)
    masks = finger_masks(rigid_object, candidates, limits)
    torsions = [candidates.contacts_twisting(finger.torsion, finger.patch).torsions for finger in limits.fingers]
    signs = [
        (mask.tobytes(), finger.strength, torsion[mask].tobytes())
        for mask, finger, torsion in zip(masks, limits.fingers, torsions, strict=True)
    ]
    distinct = list(dict.fromkeys(signs))
    first = [signs.index(sign) for sign in distinct]  # the first finger of each kind
    kinds = tuple(
        FingerKind(
            fingers=signs.count(signs[finger]),
            candidates=int(masks[finger].sum()),
            strength=float(limits.fingers[finger].strength),
        )
        for finger in first
    )
    listed = candidates.kept(np.concatenate([np.flatnonzero(masks[finger]) for finger in first]))
    torsion = np.concatenate([torsions[finger][masks[finger]] for finger in first])
    listed = replace(listed, contacts=replace(listed.contacts, torsion=torsion))
    if len(kinds) == 1 and kinds[0].strength == 1:
        return Kinds(kinds=(), candidates=listed, of_finger=alike)
    return Kinds(kinds=kinds, candidates=listed, of_finger=np.array([distinct.index(sign) for sign in signs]))


def require_room(candidates: Candidates, fingers: int, limits: Limits) -> None:
    """Refuse spacing or span that no two candidates keep: nothing would be left to search.

    Raises:
        LimitsError: If all candidates are nearer to each other than the spacing, or farther than the span.
    """
    points = candidates.contacts.points
    if fingers < 2 or len(points) < 2 or (limits.spacing == 0 and limits.span == np.inf):
        return
    farthest, nearest = 0.0, np.inf
    for first, point in enumerate(points[:-1]):
        distances = np.linalg.norm(points[first + 1 :] - point, axis=1)
        farthest, nearest = max(farthest, distances.max()), min(nearest, distances.min())
    if farthest < limits.spacing:
        raise LimitsError(
            f"spacing is {limits.spacing:g} m, but no two of the {len(points)} candidates are more than {farthest:.3g} "
            "m apart; give a smaller spacing, in metres"
        )
    if nearest > limits.span:
        raise LimitsError(
            f"span is {limits.span:g} m, but no two of the {len(points)} candidates are less than {nearest:.3g} m "
            "apart; give a larger span, in metres, or ask for more candidates"
        )
