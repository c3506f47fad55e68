"""Numbers of limits, checked: finite, of sane magnitude, of the right count and sign."""

import numpy as np

from planner.arrays import Floats
from planner.errors import LimitsError

LARGEST = 1e6
"""Largest accepted length [m] or ratio."""

DIMENSIONS = (2, 3)
"""Coordinates of a point: in the plane, in space."""


def positive(name: str, value: float) -> float:
    """A positive finite number.

    Raises:
        LimitsError: On any other number.
    """
    if not 0 < value <= LARGEST:
        raise LimitsError(f"{name} is {value}; it must be positive and at most {LARGEST:g}")
    return value


def vector(name: str, values: tuple[float, ...]) -> Floats:
    """Two or three numbers, infinite ones included, as an array.

    Raises:
        LimitsError: On another count, or on what is no number.
    """
    array = np.array(values, dtype=float)
    if len(array) not in DIMENSIONS:
        raise LimitsError(f"{name} has {len(array)} numbers; it must have 3, or 2 for a planar object")
    if np.isnan(array).any():
        raise LimitsError(f"{name} is {list(values)}; every coordinate must be a number")
    return array
