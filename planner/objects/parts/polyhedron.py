"""The points with normal_k . p <= offset_k for every facet k: a mesh geom collides as this hull of its vertices."""

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from planner.objects.parts.hull import MERGE_TOLERANCE, convex_facets
from planner.objects.vectors import norm

CHUNK = 4096
"""Points compared with all facets at once: bounds the memory of `depth`."""

TIE = 1e-9
"""Facets whose distances differ by less than this, relative to the part's size, are equally near."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Polyhedron:
    """A mesh geom, or any convex polyhedron, in the object's body frame B."""

    mjcf_type: ClassVar[str] = "mesh"

    geom: str
    """Name of the geom."""

    friction: float
    """Sliding friction coefficient."""

    vertices: np.ndarray
    """Corners, shape (corners, 3) [m]."""

    polygons: tuple[np.ndarray, ...]
    """For each facet the indices of its corners, counter-clockwise seen from outside."""

    normals: np.ndarray
    """Outward unit normals, shape (facets, 3)."""

    offsets: np.ndarray
    """Distances of the facets' planes from the origin along their normals, shape (facets,) [m]."""

    @classmethod
    def hull(cls, vertices: np.ndarray, *, geom: str, friction: float) -> "Polyhedron":
        """Convex hull of `vertices`, shape (n, 3) [m].

        Raises:
            ObjectError: If a coordinate is not finite or the points are (nearly) coplanar.
        """
        return cls(geom=geom, friction=friction, **convex_facets(vertices, geom)._asdict())

    def bounds(self) -> np.ndarray:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """Each facet fanned about its first corner; see `ConvexPart.triangles`."""
        corners = [(facet, ring[0], *pair) for facet, ring in enumerate(self.polygons) for pair in pairwise(ring[1:])]
        table = np.array(corners)
        return self.vertices[table[:, 1:]], table[:, 0]

    def nearest_facet(self, points: np.ndarray) -> np.ndarray:
        """See `ConvexPart.nearest_facet`; the first of equally near facets."""
        slack = self._slack(points)
        return (slack <= slack.min(axis=1, keepdims=True) + TIE * self._length).argmax(axis=1)

    def project(self, points: np.ndarray, facets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `ConvexPart.project`."""
        normals = self.normals[facets]
        height = (points * normals).sum(axis=1) - self.offsets[facets]
        feet = points - height[:, None] * normals
        for index in np.flatnonzero(self.depth(feet) < -MERGE_TOLERANCE * self._length):
            feet[index] = _nearest_in_polygon(self.vertices[self.polygons[facets[index]]], normals[index], feet[index])
        return feet, -normals

    def depth(self, points: np.ndarray) -> np.ndarray:
        """See `ConvexPart.depth`."""
        chunks = [self._slack(points[start : start + CHUNK]).min(axis=1) for start in range(0, len(points), CHUNK)]
        return np.concatenate(chunks) if chunks else np.zeros(0)

    def _slack(self, points: np.ndarray) -> np.ndarray:
        """How far each point lies below each facet's plane, shape (n, facets) [m]."""
        return self.offsets - points @ self.normals.T

    @property
    def _length(self) -> float:
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))


def edge_distances(corners: np.ndarray, normal: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Signed distances of coplanar points from the edges of a convex polygon, positive inside.

    Args:
        corners: Counter-clockwise about `normal`, shape (edges, 3) [m].
        normal: Unit normal of the plane, shape (3,).
        points: Shape (n, 3) [m].

    Returns:
        Shape (n, edges) [m].
    """
    edges = np.roll(corners, -1, axis=0) - corners
    inward = np.cross(normal, edges) / norm(edges)[:, None]
    return points @ inward.T - (corners * inward).sum(axis=1)


def _nearest_in_polygon(corners: np.ndarray, normal: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Nearest point of a convex polygon to a point of its plane, shape (3,)."""
    if (edge_distances(corners, normal, point[None]) >= 0).all():
        return point
    edges = np.roll(corners, -1, axis=0) - corners
    along = ((point - corners) * edges).sum(axis=1) / (edges * edges).sum(axis=1)
    feet = corners + np.clip(along, 0, 1)[:, None] * edges
    return feet[norm(feet - point).argmin()]
