"""Is a list of corners one closed line that neither crosses nor touches itself, and which way does it run?"""

import numpy as np

from planner.arrays import Floats
from planner.errors import ObjectError
from planner.objects.vectors import norm

MOST_CORNERS = 500
"""Largest number of corners."""

LARGEST = 1e6
"""Largest coordinate [m]."""

LEAST_GAP = 1e-6
"""Corners nearer than this to each other or to a far edge, relative to the polygon's size, touch it."""

LEAST_TURN = 1e-6
"""Sine of the least angle by which the line turns at a corner."""


def simple_polygon(corners: Floats, name: str) -> Floats:
    """The corners, counter-clockwise; corner 0 stays the first.

    Args:
        corners: In either sense, shape (n, 2) [m].
        name: Of the object, for messages.

    Raises:
        ObjectError: If they are too few or too many, not finite, repeated, or on a straight stretch, or if the
            line through them meets itself.
    """
    _check_corners(corners, name)
    size = float(norm(np.ptp(corners, axis=0)))
    _check_distinct(corners, LEAST_GAP * size, name)
    _check_turns(corners, name)
    _check_edges_apart(corners, LEAST_GAP * size, name)
    return corners if signed_area(corners) > 0 else np.roll(corners[::-1], 1, axis=0)


def signed_area(corners: Floats) -> float:
    """Area, positive if the corners run counter-clockwise (shoelace formula) [m^2]."""
    arms = corners - corners[0]
    return float(cross(arms, np.roll(arms, -1, axis=0)).sum() / 2)


def cross(first: Floats, second: Floats) -> Floats:
    """Cross product of plane vectors, shape (..., 2): positive where `second` points to the left of `first`."""
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def _check_corners(corners: Floats, name: str) -> None:
    if not 3 <= len(corners) <= MOST_CORNERS:
        raise ObjectError(f"the outline of '{name}' has {len(corners)} corners; 3 to {MOST_CORNERS} are allowed")
    outside = np.flatnonzero(~(np.abs(corners) <= LARGEST).all(axis=1))  # what is no number too
    if len(outside):
        raise ObjectError(
            f"corner {outside[0]} of '{name}' is {corners[outside[0]].tolist()}; coordinates must be finite and at "
            f"most {LARGEST:g} m"
        )


def _check_distinct(corners: Floats, least: float, name: str) -> None:
    first, second = np.triu_indices(len(corners), 1)
    same = np.flatnonzero(norm(corners[first] - corners[second]) <= least)
    if len(same):
        raise ObjectError(
            f"corners {first[same[0]]} and {second[same[0]]} of '{name}' are the same point; give each point once, "
            "and do not repeat the first at the end"
        )


def _check_turns(corners: Floats, name: str) -> None:
    arriving, leaving = corners - np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0) - corners
    sines = np.abs(cross(arriving, leaving)) / (norm(arriving) * norm(leaving))
    if sines.min() <= LEAST_TURN:
        raise ObjectError(f"corner {sines.argmin()} of '{name}' is in line with its two neighbours; leave it out")


def _check_edges_apart(corners: Floats, least: float, name: str) -> None:
    """Only neighbouring edges meet, in their common corner."""
    edges = np.roll(corners, -1, axis=0) - corners
    first, second = np.triu_indices(len(corners), 2)
    far = (first > 0) | (second < len(corners) - 1)  # the last edge is a neighbour of the first
    first, second = first[far], second[far]
    meeting = np.flatnonzero(_distances(corners[first], edges[first], corners[second], edges[second]) <= least)
    if len(meeting):
        raise ObjectError(
            f"edges {first[meeting[0]]} and {second[meeting[0]]} of '{name}' meet (edge k runs from corner k to the "
            "next); the outline must be one line that neither crosses nor touches itself"
        )


def _distances(starts: Floats, edges: Floats, other_starts: Floats, other_edges: Floats) -> Floats:
    """Distances between segments, pair by pair, shape (pairs,): zero where they cross, else from some end [m]."""
    ends, other_ends = starts + edges, other_starts + other_edges
    splits = cross(edges, other_starts - starts) * cross(edges, other_ends - starts) < 0
    split = cross(other_edges, starts - other_starts) * cross(other_edges, ends - other_starts) < 0
    from_ends = [
        *(_from_segment(points, other_starts, other_edges) for points in (starts, ends)),
        *(_from_segment(points, starts, edges) for points in (other_starts, other_ends)),
    ]
    return np.where(splits & split, 0.0, np.min(from_ends, axis=0))


def _from_segment(points: Floats, starts: Floats, edges: Floats) -> Floats:
    """Distance of each point from its segment, shape (pairs,) [m]."""
    along = ((points - starts) * edges).sum(axis=1) / (edges * edges).sum(axis=1)
    return norm(points - starts - np.clip(along, 0, 1)[:, None] * edges)
