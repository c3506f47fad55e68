"""Lengths and directions, added up in a fixed order so that every platform computes the same bits."""

import numpy as np

from planner.arrays import Floats


def norm(vectors: Floats) -> Floats:
    """Euclidean lengths over the last axis."""
    return np.sqrt((vectors * vectors).sum(axis=-1))


def unit(vectors: Floats) -> Floats:
    """Unit vectors along `vectors`, shape (..., d); the first axis where one vanishes."""
    length = norm(vectors)[..., None]
    first_axis = np.eye(vectors.shape[-1])[0]
    return np.where(length > 0, vectors / np.where(length > 0, length, 1.0), first_axis)
