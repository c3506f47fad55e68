"""Which candidates each finger may use."""

import numpy as np

from planner.arrays import Mask
from planner.candidates.candidates import Candidates
from planner.errors import CandidateError, LimitsError
from planner.limits.geoms import on_geoms
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable


def finger_masks(rigid_object: Graspable, candidates: Candidates, limits: Limits) -> Mask:
    """Whether each finger may use each candidate: it lies on one of the finger's geoms and in its box.

    Args:
        rigid_object: The object.
        candidates: On its surface, those that `restricted` leaves.
        limits: What the fingers can do.

    Returns:
        Shape (fingers, n), boolean; no rows where the limits do not tell fingers apart.

    Raises:
        CandidateError: If a finger may use none.
    """
    masks = np.ones((len(limits.fingers), len(candidates)), dtype=bool)
    for finger, mask in zip(limits.fingers, masks, strict=True):
        if finger.geoms is not None:
            mask &= on_geoms(rigid_object, candidates, finger.geoms)
        if finger.within is not None:
            mask &= finger.within.holds(candidates.contacts.points)
    idle = np.flatnonzero(~masks.any(axis=1))
    if len(idle):
        raise CandidateError(
            f"finger {idle[0] + 1} may use none of the {len(candidates)} candidates; loosen its geoms or its box, or "
            "ask for more candidates"
        )
    return masks


def require_finger_count(limits: Limits, fingers: int) -> None:
    """Refuse limits that tell fingers apart but not as many as there are.

    Raises:
        LimitsError: If there are tables [[finger]], and not one for every finger.
    """
    if limits.fingers and len(limits.fingers) != fingers:
        raise LimitsError(
            f"the limits hold {len(limits.fingers)} tables [[finger]] for {fingers} fingers; give one for every finger "
            "(--fingers), or none"
        )
