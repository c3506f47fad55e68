"""No contact in forbidden boxes."""

import numpy as np

from planner.arrays import Mask
from planner.candidates.candidates import Candidates
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable


def outside_boxes(rigid_object: Graspable, candidates: Candidates, limits: Limits) -> Mask:
    """Whether each candidate lies in none of the boxes of `keep_out`, their borders included, shape (n,)."""
    outside = np.ones(len(candidates), dtype=bool)
    for box in limits.keep_out:
        outside &= ~box.holds(candidates.contacts.points)
    return outside
