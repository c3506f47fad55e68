"""Where straight lines cross triangles: one each, or all of a surface."""

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.neighbour_blocks import neighbour_blocks
from planner.objects.vectors import norm

EDGE = 1e-9
"""How far, relative to a triangle, a ray may miss it and still hit: rays through shared edges must not slip between."""

AT_ONCE = 2**18
"""Rays compared with balls, or with triangles, at once: bounds the memory."""


def ray_hits(triangles: Floats, origins: Floats, directions: Floats) -> Floats:
    """Distances t at which rays o + t d meet triangles, infinite where they do not.

    In the triangle (a, b, c) the point is a + u (b - a) + v (c - a); (t, u, v) is solved by Cramer's rule (Möller and
    Trumbore, 1997).

    Args:
        triangles: Shape (..., 3, 3) [m].
        origins: Shape (..., 3), broadcast against the triangles [m].
        directions: Of the same shape.

    Returns:
        Shape (...), in units of the directions' lengths; negative behind the origin.
    """
    a, b, c = triangles[..., 0, :], triangles[..., 1, :], triangles[..., 2, :]
    across = np.cross(directions, c - a)
    determinant = (across * (b - a)).sum(axis=-1)
    from_a = origins - a
    other = np.cross(from_a, b - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        u = (from_a * across).sum(axis=-1) / determinant
        v = (directions * other).sum(axis=-1) / determinant
        t = ((c - a) * other).sum(axis=-1) / determinant
        inside = (u >= -EDGE) & (v >= -EDGE) & (u + v <= 1 + EDGE)
    return np.where(inside, t, np.inf)


def crossings(triangles: Floats, origins: Floats, directions: Floats) -> tuple[Indices, Indices, Floats]:
    """All places where rays meet triangles ahead of their origins, some of them more than once.

    The triangles are kept in blocks of neighbours; a ray is compared with those of the blocks whose ball it meets.

    Args:
        triangles: Shape (triangles, 3, 3) [m].
        origins: Shape (rays, 3) [m].
        directions: Unit vectors, shape (rays, 3).

    Returns:
        The ray and the triangle, and how far ahead they meet [m], ray by ray, shape (crossings,) each.
    """
    blocks = neighbour_blocks(triangles.mean(axis=1))
    corners = triangles[blocks].reshape(len(blocks), -1, 3)
    middles = (corners.min(axis=1) + corners.max(axis=1)) / 2
    radii = norm(corners - middles[:, None]).max(axis=1) * (1 + EDGE)
    ray, block = _near(middles, radii, origins, directions)
    step = max(1, AT_ONCE // blocks.shape[1])
    rays, hits, distances = [ray[:0]], [block[:0]], [np.empty(0)]
    for some in (slice(start, start + step) for start in range(0, len(ray), step)):
        asked, here = blocks[block[some]], ray[some]
        ahead = ray_hits(triangles[asked], origins[here, None], directions[here, None])
        pair, place = np.nonzero((ahead > 0) & np.isfinite(ahead))
        rays.append(here[pair])
        hits.append(asked[pair, place])
        distances.append(ahead[pair, place])
    return np.concatenate(rays), np.concatenate(hits), np.concatenate(distances)


def _near(middles: Floats, radii: Floats, origins: Floats, directions: Floats) -> tuple[Indices, Indices]:
    """Which lines come within which balls: line and ball, shape (pairs,) each."""
    lines, balls = [np.empty(0, dtype=int)], [np.empty(0, dtype=int)]
    step = max(1, AT_ONCE // len(middles))
    for start in range(0, len(origins), step):
        to = middles - origins[start : start + step, None]
        away = norm(np.cross(to, directions[start : start + step, None]))
        line, ball = np.nonzero(away <= radii)
        lines.append(start + line)
        balls.append(ball)
    return np.concatenate(lines), np.concatenate(balls)
