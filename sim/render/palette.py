"""The colours of the pictures: those of the report page, and warm grey for the object."""

import numpy as np

from planner.arrays import Singles

INK, MUTED, LINE = "#1b2733", "#64748b", "#d5dce6"
"""Words, lesser words, lines."""
BACKGROUND, PAPER = "#f4f6f9", "#ffffff"
"""Behind the object; behind the words."""
OBJECT, EDGE, GHOST = "#c9c1b6", "#6f675d", "#8b97a8"
"""The object, its edges, and its edges where it was planned."""
TIP = "#475569"
"""Fingertips."""
FORCE, LOAD = "#d55e00", "#6d28d9"
"""Measured contact forces, and the wrench that they hold."""
CONE = "#0072b2"
"""Friction cones and the numbers of their contacts."""
HELD, SLIPPED = "#15803d", "#b91c1c"


def rgb(color: str) -> tuple[int, int, int]:
    """A colour as red, green and blue from 0 to 255."""
    red, green, blue = bytes.fromhex(color.removeprefix("#"))
    return red, green, blue


def rgba(color: str, opacity: float = 1.0) -> Singles:
    """A colour as MuJoCo takes it, shape (4,), from 0 to 1."""
    return np.array([*(part / 255 for part in rgb(color)), opacity], dtype=np.float32)
