"""Cuts a simple polygon into triangles between its own corners.

An ear is a corner whose triangle with its two neighbours lies inside the polygon. Every simple polygon of more than
three corners has at least two, so they can be cut off one after another. Source: Meisters, Polygons have ears (1975).
"""

import numpy as np

from planner.arrays import Floats
from planner.errors import ObjectError
from planner.objects.planar.simple_polygon import cross
from planner.objects.vectors import norm


def triangles(corners: Floats) -> list[tuple[int, int, int]]:
    """Triangles that fill the polygon without overlap; always the ear with the shortest cut, which avoids slivers.

    Args:
        corners: A simple polygon, counter-clockwise, shape (n, 2) [m].

    Returns:
        n - 2 triples of corner numbers, counter-clockwise.

    Raises:
        ObjectError: If rounding leaves no ear: the polygon is nearly flat somewhere.
    """
    ring, cut_off = list(range(len(corners))), []
    while len(ring) > 3:
        ears = [place for place in range(len(ring)) if _is_ear(corners[ring], place)]
        if not ears:
            raise ObjectError("the outline cannot be cut into triangles; remove corners that nearly touch far edges")
        cuts = [float(norm(corners[ring[place - 1]] - corners[ring[(place + 1) % len(ring)]])) for place in ears]
        place = ears[int(np.argmin(cuts))]
        cut_off.append((ring[place - 1], ring[place], ring[(place + 1) % len(ring)]))
        del ring[place]
    first, second, third = ring
    return [*cut_off, (first, second, third)]


def is_convex(corners: Floats) -> bool:
    """Whether a simple polygon, counter-clockwise, turns left at every corner."""
    edges = np.roll(corners, -1, axis=0) - corners
    return bool((cross(np.roll(edges, 1, axis=0), edges) > 0).all())


def _is_ear(corners: Floats, place: int) -> bool:
    """Whether the corner turns left and no other corner lies in its triangle or on its cut."""
    around = [(place - 1) % len(corners), place, (place + 1) % len(corners)]
    before, corner, after = corners[around]
    if cross(corner - before, after - corner) <= 0:
        return False
    others = np.delete(corners, around, axis=0)
    inside = (
        (cross(corner - before, others - before) >= 0)
        & (cross(after - corner, others - corner) >= 0)
        & (cross(before - after, others - after) >= 0)
    )
    return not inside.any()
