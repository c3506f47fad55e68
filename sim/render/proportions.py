"""How large arrows, arcs and cones are drawn, relative to the object's size; pictures and the live view share it."""

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.objects.vectors import unit_arc

ARROW = 0.34
"""Length of an arrow of rho, relative to the object's size, as on the report page."""
SHAFT = 0.0085
"""Radius of its shaft, relative to the object's size."""
HEAD_RADIUS, HEAD_LENGTH = 2.5, 6.0
"""Of an arrow, relative to the radius of its shaft."""
LARGEST_HEAD = 0.6
"""Part of a short arrow that is head."""
LEAST_FORCE = 1e-3
"""A smaller force is not drawn, relative to rho, nor a torque, relative to a full arc."""
FULL_TURN = 1.4 * np.pi
"""Arc of a full moment [rad]."""
ARC_PIECES = 40
"""Rods of which it is made."""
ARC_ROD = 0.85 * SHAFT
"""Their radius, relative to the object's size."""
SHORT = 4.0
"""The head of an arc shorter than a SHORTth part of the full one shrinks with it."""
TWIST = 0.06
"""Radius of the arc of a finger's torque, relative to the object's size, as on the report page."""
BEYOND = 0.24
"""How far outside its contact it stands, beyond the friction cone's mouth, relative to the object's size."""
CONE_HEIGHT = 0.2
"""Height of a friction cone, relative to the object's size, as on the report page."""
CONE_OPACITY = 0.24
LABEL_DEPTH = 0.07
"""How far inside the contact its number stands, relative to the object's size, as on the report page."""


def arrow_head(length: float, radius: float) -> tuple[float, float]:
    """Length and radius of the head of an arrow of some length whose shaft has some radius."""
    head = min(HEAD_LENGTH * radius, LARGEST_HEAD * length)
    return head, HEAD_RADIUS * radius * min(1.0, head / (HEAD_LENGTH * radius))


def arc(axis: Floats, share: float, size: float) -> tuple[Floats, Floats]:
    """Points of an arc about the origin, shape (n, 3), and the direction in which it ends, shape (3,).

    Args:
        axis: Unit vector that it turns about, shape (3,).
        share: How much of the full arc.
        size: Its radius.
    """
    points, heading = unit_arc(axis, share * FULL_TURN, max(1, round(share * ARC_PIECES)))
    return size * points, heading


def twists(torques: Floats, contacts: Contacts) -> Floats:
    """Parts of a full arc that torques are drawn with, signed, shape (contacts,).

    A full arc is the most that a finger pressing with rho holds, max gamma s rho, as a full arrow is rho.

    Args:
        torques: About the inward normals, shape (contacts,) [N m]; the newton is rho.
        contacts: Where they act.
    """
    full = float((contacts.torsions * contacts.strengths).max())
    return torques / full if full else np.zeros_like(torques)


def arc_head(share: float, radius: float) -> tuple[float, float]:
    """Length and radius of the head of an arc made of rods of some radius."""
    scale = radius * min(1.0, SHORT * share)
    return HEAD_LENGTH * scale, HEAD_RADIUS * scale
