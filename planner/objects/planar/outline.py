"""A simple polygon: the whole surface of a planar object, its edges the facets.

Corners run counter-clockwise, edge k from corner k to corner k + 1. Frame: the object's body frame B, SI.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.objects.planar.simple_polygon import signed_area
from planner.objects.vectors import norm

CHUNK = 4096
"""Points compared with all edges at once: bounds the memory of `depth`."""

TIE = 1e-9
"""Edges whose distances differ by less than this, relative to the outline's size, are equally near."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Outline:
    """The one `Part` of a planar object: the area inside, convex or not."""

    geom: str
    """Name of the object."""

    friction: float
    """Sliding friction coefficient."""

    corners: Floats
    """A `simple_polygon`, shape (edges, 2) [m]."""

    @cached_property
    def edges(self) -> Floats:
        """From each corner to the next, shape (edges, 2) [m]."""
        return np.roll(self.corners, -1, axis=0) - self.corners

    @cached_property
    def lengths(self) -> Floats:
        """Of the edges, shape (edges,) [m]."""
        return norm(self.edges)

    @cached_property
    def normals(self) -> Floats:
        """Inward unit normals of the edges, shape (edges, 2)."""
        tangents = self.edges / self.lengths[:, None]
        return np.column_stack([-tangents[:, 1], tangents[:, 0]])

    @property
    def area(self) -> float:
        """[m^2]"""
        return signed_area(self.corners)

    @property
    def centroid(self) -> Floats:
        """Centre of the area, shape (2,) [m]: the mean of the triangles fanned about corner 0, weighted by area."""
        arms = self.corners - self.corners[0]
        after = np.roll(arms, -1, axis=0)
        doubled = arms[:, 0] * after[:, 1] - arms[:, 1] * after[:, 0]
        return self.corners[0] + doubled @ (arms + after) / (3 * doubled.sum())

    def bounds(self) -> Floats:
        """See `Part.bounds`."""
        return np.stack([self.corners.min(axis=0), self.corners.max(axis=0)])

    def nearest_facet(self, points: Floats) -> Indices:
        """See `Part.nearest_facet`; the first of equally near edges."""
        tie = TIE * float(norm(np.ptp(self.bounds(), axis=0)))
        nearest = [
            (distances <= distances.min(axis=1, keepdims=True) + tie).argmax(axis=1)
            for distances, _ in self._distances(points)
        ]
        return np.concatenate([np.zeros(0, dtype=np.int64), *nearest])

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """See `Part.project`."""
        starts, edges = self.corners[facets], self.edges[facets]
        along = ((points - starts) * edges).sum(axis=1) / self.lengths[facets] ** 2
        return starts + np.clip(along, 0, 1)[:, None] * edges, self.normals[facets]

    def depth(self, points: Floats) -> Floats:
        """See `Part.depth`; the magnitude is the distance from the nearest edge."""
        depths = [np.where(inside, 1, -1) * distances.min(axis=1) for distances, inside in self._distances(points)]
        return np.concatenate([np.zeros(0), *depths])

    def corner_distance(self, point: Floats) -> float:
        """Distance from `point`, shape (2,), to the nearest corner [m]."""
        return float(norm(self.corners - point).min())

    def _distances(self, points: Floats) -> Iterator[tuple[Floats, Mask]]:
        """Chunk by chunk, distances to all edges, (n, edges), and whether each point is inside, (n,).

        Inside: a ray along x crosses the outline an odd number of times.
        """
        ends = self.corners + self.edges
        for first in range(0, len(points), CHUNK):
            chunk = points[first : first + CHUNK, None]
            arms = chunk - self.corners
            along = np.clip((arms * self.edges).sum(axis=2) / self.lengths**2, 0, 1)
            distances = norm(arms - along[:, :, None] * self.edges)
            across = (self.corners[:, 1] > chunk[:, :, 1]) != (ends[:, 1] > chunk[:, :, 1])
            left = self.edges[:, 0] * arms[:, :, 1] - self.edges[:, 1] * arms[:, :, 0] > 0
            crossed = across & (left == (self.edges[:, 1] > 0))
            yield distances, crossed.sum(axis=1) % 2 == 1
