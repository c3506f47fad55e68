"""Does the object weigh what the grasp says?"""

import numpy as np

from planner.grasps.grasp import Grasp
from planner.millimetres import in_mm, point_in_mm
from planner.objects.graspable import Graspable
from planner.verification.check import Check, checked, not_checked

AGREEMENT = 1e-6
"""Relative accuracy of masses and, relative to the object's size, of the centre of mass."""

NO_OBJECT = "the object was not read"


def check_mass(grasp: Grasp, rigid_object: Graspable | None) -> Check:
    """Mass and centre of mass are the object's, or those that the grasp says were given in their place."""
    given = "" if grasp.source.given.mass is None else ", given in place of the file's"
    claim = f"the object's mass is {grasp.mass:.6g} kg{given}"
    if grasp.center_of_mass is not None:
        claim += f", its centre at {point_in_mm(grasp.center_of_mass)} mm"
    if rigid_object is None:
        return not_checked(claim, NO_OBJECT)
    shift = 0.0
    if grasp.center_of_mass is not None:
        shift = float(np.abs(grasp.center_of_mass - rigid_object.center_of_mass).max())
    return checked(
        claim,
        abs(grasp.mass - rigid_object.mass) <= AGREEMENT * rigid_object.mass and shift <= AGREEMENT * rigid_object.size,
        f"read again: {rigid_object.mass:.6g} kg, the centre {in_mm(shift, 2)} mm away",
    )
