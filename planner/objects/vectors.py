"""Lengths and directions, added up in a fixed order so that every platform computes the same bits."""

import numpy as np

from planner.arrays import Floats
from planner.contacts import contact_frames


def norm(vectors: Floats) -> Floats:
    """Euclidean lengths over the last axis."""
    return np.sqrt((vectors * vectors).sum(axis=-1))


def unit(vectors: Floats) -> Floats:
    """Unit vectors along `vectors`, shape (..., d); the first axis where one vanishes."""
    length = norm(vectors)[..., None]
    first_axis = np.eye(vectors.shape[-1])[0]
    return np.where(length > 0, vectors / np.where(length > 0, length, 1.0), first_axis)


def unit_arc(axis: Floats, angle: float, pieces: int) -> tuple[Floats, Floats]:
    """Points of an arc of radius 1 about the origin, shape (pieces + 1, 3), and the direction in which it ends, (3,).

    Args:
        axis: Unit vector that it turns about, right-handed, shape (3,).
        angle: How far it goes [rad].
        pieces: Of how many equal pieces it is made, 1 or more.
    """
    _, first, second = contact_frames(axis[None])[0].T
    angles = np.linspace(0, angle, 1 + pieces)
    points = np.outer(np.cos(angles), first) + np.outer(np.sin(angles), second)
    return points, np.cos(angles[-1]) * second - np.sin(angles[-1]) * first
