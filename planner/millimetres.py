"""Lengths as they are printed: what is typed and written to files is in metres, what is read on a screen in mm."""

import numpy as np

from planner.arrays import Floats

LEAST = 1e-9
"""What is shorter is rounding, and nothing [m]."""


def in_mm(length: float, digits: int = 4) -> str:
    """A length [m] in mm: so many significant digits, never an exponent, without the unit."""
    if not np.isfinite(length):
        return str(float(length))
    shown = 0.0 if abs(length) < LEAST else 1000 * float(length)
    return np.format_float_positional(shown, precision=digits, unique=False, fractional=False, trim="-")


def point_in_mm(point: Floats) -> str:
    """A point, shape (d,) [m], as (x, y, z) in mm to a thousandth, without the unit."""
    return f"({', '.join(f'{round(1000 * coordinate, 3) + 0.0:.9g}' for coordinate in point)})"  # + 0.0: no "-0"
