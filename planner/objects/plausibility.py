"""What is allowed and yet almost always a mistake: one sentence each, with the value and its likely cause.

Every function returns its sentences, none where all is well; whoever knows the values logs them as warnings.
Doubts about mass properties are in `planner.objects.mass_doubts`.
"""

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.millimetres import in_mm
from planner.objects.graspable import Graspable

SIZES = (0.002, 3.0)
"""Shortest and longest plausible object: a grain of rice is 6 mm, a door 2 m [m]."""

MOST_FRICTION = 2.0
"""Coefficients of soft rubber on dry, clean surfaces reach it."""

CANDIDATES_PER_FINGER = 10
"""With fewer the best of them says little about the object."""

GRAVITY_TOLERANCE = 0.005
"""Relative; standard gravity differs by as much over the Earth."""


def size_doubts(seen: Graspable) -> list[str]:
    """Whether the object's longest edge is that of something to grasp."""
    longest, (least, most) = float(seen.extent.max()), SIZES
    if least <= longest <= most:
        return []
    cause = (
        "are its numbers, or those of its meshes, millimetres? (give the meshes scale 0.001)"
        if longest > most
        else "is a scale of 0.001 applied to numbers that were metres already?"
    )
    return [f"body '{seen.body}' is {in_mm(longest)} mm long; lengths in its file are metres: {cause}"]


def gravity_doubts(stated: float | None, assumed: float) -> list[str]:
    """Whether a file states another gravity than the one that weights are taken with.

    Args:
        stated: Magnitude in the object's file; None where it states none [m/s^2].
        assumed: [m/s^2].
    """
    if stated is None or abs(stated - assumed) <= GRAVITY_TOLERANCE * assumed:
        return []
    return [
        f"the object's file says gravity {stated:.4g} m/s2, but this task takes the weight at {assumed:g} m/s2; for "
        "another one state the forces in a task file"
    ]


def grid_doubts(seen: Graspable, spacing: float) -> list[str]:
    """Whether the cells of a grid, of that edge length [m], are longer than the parts they divide."""
    longest = [float(np.ptp(part.bounds(), axis=0).max()) for part in seen.parts]
    smaller = [part.geom for part, length in zip(seen.parts, longest, strict=True) if length < spacing]
    if not smaller:
        return []
    others = f" and {len(smaller) - 1} more" if len(smaller) > 1 else ""
    return [
        f"a grid of {in_mm(spacing)} mm is wider than '{smaller[0]}'{others}: one candidate in the middle of "
        "each facet is left; is the spacing in metres?"
    ]


def friction_doubts(friction: Floats) -> list[str]:
    """Whether coefficients, shape (n,), are those of materials."""
    most = float(friction.max(initial=0))
    if most <= MOST_FRICTION:
        return []
    return [
        f"a friction coefficient of {most:.4g} is more than any two dry materials have (0.2 to 1, soft rubber up to "
        f"{MOST_FRICTION:g}); is it an angle in degrees, or a simulation's setting? (--friction)"
    ]


def torsion_doubts(seen: Graspable, contacts: Contacts) -> list[str]:
    """Whether the object has room for the patches that give the contacts their torsional friction.

    Whatever its pressure, a patch of radius a gives at most mu a, at its rim; none is wider than the second of the
    object's edges.
    """
    radii = contacts.torsions / contacts.friction
    if not radii.any() or np.sort(seen.extent)[-2] >= 2 * radii.max():
        return []
    worst = radii.argmax()
    torsion, friction = contacts.torsions[worst], contacts.friction[worst]
    size = " x ".join(in_mm(edge) for edge in seen.extent)
    return [
        f"a torsional friction of {in_mm(torsion, 3)} mm takes a patch of {in_mm(radii.max(), 3)} mm radius or more at "
        f"friction {friction:.3g}, and the object is {size} mm; torsion and patch are lengths in metres: were "
        "millimetres given?"
    ]


def candidate_doubts(candidates: int, fingers: int) -> list[str]:
    """Whether there is much to choose from; with one for each finger there is no choice, and fewer are refused."""
    if candidates <= fingers or candidates >= CANDIDATES_PER_FINGER * fingers:
        return []
    return [
        f"{candidates} candidates are few for {fingers} fingers: the best of them may be far from the best on the "
        f"object, or none may hold; ask for {CANDIDATES_PER_FINGER * fingers} or more"
    ]
