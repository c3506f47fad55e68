"""Numbers of a required external force set, checked: finite, of sane magnitude, of the right count and sign."""

from collections.abc import Sequence

import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension
from planner.errors import TaskError

LARGEST = 1e12
"""Largest accepted magnitude, in any SI unit: no product of two of them can overflow."""


def finite_vector(name: str, values: Sequence[float], allowed: Sequence[int]) -> Floats:
    """The values as an array.

    Args:
        name: What they are, for the message.
        values: Any count of numbers.
        allowed: The counts that are allowed.

    Raises:
        TaskError: On another count, or on a value that is not finite or too large.
    """
    vector = np.asarray(values, dtype=float)
    if vector.ndim != 1 or len(vector) not in allowed:
        counts = " or ".join(str(count) for count in allowed)
        raise TaskError(f"{name} has shape {vector.shape}; expected {counts} numbers")
    if not (np.abs(vector) <= LARGEST).all():  # what is no number is refused too
        raise TaskError(f"{name} must be finite and at most {LARGEST:g} in magnitude, got {vector.tolist()}")
    return vector


def size(name: str, value: float, *, zero: bool) -> float:
    """One finite length, positive or, where `zero` is allowed, not negative.

    Raises:
        TaskError: On any other number.
    """
    if not 0 <= value <= LARGEST or (value == 0 and not zero):
        sign = "not negative" if zero else "positive"
        raise TaskError(f"{name} must be finite and {sign}, at most {LARGEST:g}, got {value}")
    return float(value)


def half_sizes(force: Sequence[float], moment: Sequence[float]) -> Floats:
    """Sizes along the D axes of wrench space, each finite and not negative, shape (D,) [N, N m].

    Args:
        force: 2 numbers in the plane, 3 in space [N].
        moment: 1 number in the plane, 3 in space [N m].

    Raises:
        TaskError: On a wrong count, or a size that is negative or not finite.
    """
    forces = finite_vector("force", force, (2, 3))
    dimension = len(forces)
    sizes = np.concatenate([forces, finite_vector("moment", moment, (wrench_dimension(dimension) - dimension,))])
    if sizes.min() < 0:
        raise TaskError(f"force and moment sizes must not be negative, got {sizes.tolist()}")
    return sizes


def center_vector(center: Sequence[float] | None, dimension: int) -> Floats:
    """Centre of a set in wrench space, shape (D,); the origin where none is given.

    Args:
        center: D numbers [N, N m], or nothing.
        dimension: D.

    Raises:
        TaskError: On a wrong count or a value that is not finite.
    """
    return np.zeros(dimension) if center is None else finite_vector("center", center, (dimension,))


def space_dimension(dimension: int) -> int:
    """The dimension d of the object's space.

    Raises:
        TaskError: Unless it is 2 or 3.
    """
    if dimension not in (2, 3):
        raise TaskError(f"dimension must be 2 (plane) or 3 (space), got {dimension}")
    return dimension
