"""Rays against the object's triangles: what the camera sees, and where a line leaves the object."""

import numpy as np

from planner.arrays import Floats, Mask

EDGE = 1e-9
"""How far, relative to a triangle, a ray may miss it and still hit: rays through shared edges must not slip between."""


def ray_hits(triangles: Floats, origins: Floats, directions: Floats) -> Floats:
    """Distances t at which rays o + t d meet triangles, infinite where they do not.

    In the triangle (a, b, c) the point is a + u (b - a) + v (c - a); (t, u, v) is solved by Cramer's rule (Möller and
    Trumbore, 1997).

    Args:
        triangles: Shape (triangles, 3, 3) [m].
        origins: Shape (rays, 3) [m].
        directions: Shape (rays, 3).

    Returns:
        Shape (rays, triangles), in units of the directions' lengths; negative behind the origin.
    """
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    across = np.cross(directions[:, None], c - a)
    determinant = (across * (b - a)).sum(axis=-1)
    from_a = origins[:, None] - a
    other = np.cross(from_a, b - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        u = (from_a * across).sum(axis=-1) / determinant
        v = (directions[:, None] * other).sum(axis=-1) / determinant
        t = ((c - a) * other).sum(axis=-1) / determinant
        inside = (u >= -EDGE) & (v >= -EDGE) & (u + v <= 1 + EDGE)
    return np.where(inside, t, np.inf)


def open_to(triangles: Floats, points: Floats, direction: Floats) -> Mask:
    """Whether nothing lies between each point, shape (points, 3), and a far eye in one direction, shape (points,)."""
    hits = ray_hits(triangles, points, np.broadcast_to(direction, points.shape))
    nearest = np.where(hits > 0, hits, np.inf).min(axis=1, initial=np.inf)
    return np.isinf(nearest)


def exit_distance(triangles: Floats, point: Floats, direction: Floats) -> float:
    """How far from a point a ray leaves the object for good [m]; zero where it does not meet it."""
    hits = ray_hits(triangles, point[None], direction[None])
    return float(np.where(np.isfinite(hits), hits, 0.0).max(initial=0.0))
