"""Rays against the object's triangles: what the camera sees, and where a line leaves the object."""

import numpy as np

from planner.arrays import Floats, Mask
from planner.objects.surface.rays import ray_hits


def open_to(triangles: Floats, points: Floats, direction: Floats) -> Mask:
    """Whether nothing lies between each point, shape (points, 3), and a far eye in one direction, shape (points,)."""
    hits = ray_hits(triangles, points[:, None], direction)
    return np.asarray(~((hits > 0) & np.isfinite(hits)).any(axis=1))


def exit_distance(triangles: Floats, point: Floats, direction: Floats) -> float:
    """How far from a point a ray leaves the object for good [m]; zero where it does not meet it."""
    hits = ray_hits(triangles, point, direction)
    return float(np.where(np.isfinite(hits), hits, 0.0).max(initial=0.0))
