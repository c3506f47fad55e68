"""Do limits fit an object: are there such geoms, and do points have as many coordinates?"""

from planner.errors import LimitsError
from planner.limits.geoms import matches
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable


def require_fit(limits: Limits, rigid_object: Graspable) -> None:
    """Refuse limits that name what the object does not have.

    Raises:
        LimitsError: If a name or pattern matches none of the object's geoms, a vector is of another dimension, or
            fingers twist in the plane.
    """
    names = list(dict.fromkeys(part.geom for part in rigid_object.parts))
    for pattern in _patterns(limits):
        if not any(matches(name, pattern) for name in names):
            raise LimitsError(f"the object has no geom '{pattern}'; it has {', '.join(names)}")
    dimension = len(rigid_object.extent)
    for name, vector in _vectors(limits):
        if len(vector) != dimension:
            raise LimitsError(f"{name} has {len(vector)} numbers; points of this object have {dimension}")
    if dimension == 2 and any(finger.torsion or finger.patch for finger in limits.fingers):
        raise LimitsError("a finger's torsion or patch resists turning about the normal, which is for objects in space")


def _patterns(limits: Limits) -> list[str]:
    return [*limits.exclude_geoms, *(pattern for finger in limits.fingers for pattern in finger.geoms or ())]


def _vectors(limits: Limits) -> list[tuple[str, tuple[float, ...]]]:
    """A vector of each table, and its name; the corners of a box are alike."""
    vectors = [("keep_out.lower", box.lower) for box in limits.keep_out]
    vectors += [("finger.within.lower", finger.within.lower) for finger in limits.fingers if finger.within]
    return vectors + ([("table.normal", limits.table.normal)] if limits.table else [])
