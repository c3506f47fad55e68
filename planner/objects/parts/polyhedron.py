"""The points with normal_k . p <= offset_k for every facet k: a mesh geom collides as this hull of its vertices."""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from scipy.spatial import ConvexHull

from planner.arrays import Floats, Indices
from planner.objects.parts.hull import MERGE_TOLERANCE, convex_facets
from planner.objects.parts.planes import MOST_ASKED, Planes
from planner.objects.vectors import norm

TIE = 1e-9
"""Facets whose distances differ by less than this, relative to the part's size, are equally near."""

CORE = 300
"""Facets whose corners span the core of a polyhedron of many facets."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Polyhedron:
    """A mesh geom, or any convex polyhedron, in the object's body frame B."""

    mjcf_type: ClassVar[str] = "mesh"

    geom: str
    """Name of the geom."""

    friction: float
    """Sliding friction coefficient."""

    vertices: Floats
    """Corners, shape (corners, 3) [m]."""

    polygons: tuple[Indices, ...]
    """For each facet the indices of its corners, counter-clockwise seen from outside."""

    outward_normals: Floats
    """Unit normals, shape (facets, 3)."""

    offsets: Floats
    """Distances of the facets' planes from the origin along their normals, shape (facets,) [m]."""

    @classmethod
    def hull(cls, vertices: Floats, *, geom: str, friction: float) -> "Polyhedron":
        """Convex hull of `vertices`, shape (n, 3) [m].

        Raises:
            ObjectError: If a coordinate is not finite or the points are (nearly) coplanar.
        """
        return cls(geom=geom, friction=friction, **convex_facets(vertices, geom)._asdict())

    def bounds(self) -> Floats:
        """Lower and upper corner of the bounding box in B, shape (2, 3) [m]."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    def triangles(self) -> tuple[Floats, Indices]:
        """Each facet fanned about its first corner; see `ConvexPart.triangles`."""
        corners, counts = np.concatenate(self.polygons), np.array([len(ring) for ring in self.polygons])
        facets = np.repeat(np.arange(len(counts)), counts - 2)
        first = (counts.cumsum() - counts)[facets]
        second = np.arange(len(facets)) + 2 * facets + 1  # every facet before has two corners more than triangles
        return self.vertices[corners[np.column_stack([first, second, second + 1])]], facets

    def nearest_facet(self, points: Floats) -> Indices:
        """See `ConvexPart.nearest_facet`; the first of equally near facets."""
        return self._planes.nearest(points, TIE * self._length)

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """See `ConvexPart.project`."""
        outward = self.outward_normals[facets]
        height = (points * outward).sum(axis=1) - self.offsets[facets]
        feet = points - height[:, None] * outward
        doubtful = np.arange(len(feet)) if len(self.offsets) <= MOST_ASKED else self._beside(feet, facets)
        outside = doubtful[self.depth(feet[doubtful]) < -MERGE_TOLERANCE * self._length]
        for index in outside:
            feet[index] = _nearest_in_polygon(self.vertices[self.polygons[facets[index]]], outward[index], feet[index])
        return feet, -outward

    def depth(self, points: Floats) -> Floats:
        """See `ConvexPart.depth`; of many facets the nearest is sought only for points outside of the core."""
        if len(self.offsets) <= MOST_ASKED:
            return self._planes.depth(points)
        depths = self._core.depth(points) - MERGE_TOLERANCE * self._length  # corners may stick out of planes by that
        outside = np.flatnonzero(depths <= 0)
        depths[outside] = self._planes.depth(points[outside])
        return depths

    def _beside(self, feet: Floats, facets: Indices) -> Indices:
        """Indices of the points of facets' planes that are not in the first triangle of their facet."""
        corners = self.vertices[np.array([self.polygons[facet][:3] for facet in facets]).reshape(-1, 3)]
        edges = np.roll(corners, -1, axis=1) - corners
        sides = np.cross(edges, feet[:, None] - corners) @ self.outward_normals[facets][:, :, None]
        return np.flatnonzero((sides[..., 0] < 0).any(axis=1))

    @cached_property
    def _planes(self) -> Planes:
        corners, counts = np.concatenate(self.polygons), np.array([len(ring) for ring in self.polygons])
        sums = np.add.reduceat(self.vertices[corners], counts.cumsum() - counts)
        return Planes(outward_normals=self.outward_normals, offsets=self.offsets, middles=sums / counts[:, None])

    @cached_property
    def _core(self) -> Planes:
        """Hull of the corners of some facets: a point is in the polyhedron as deep as in this, or deeper."""
        some = self.polygons[:: len(self.polygons) // CORE]
        hull = ConvexHull(self.vertices[np.unique(np.concatenate(some))])
        middles = hull.points[hull.simplices].mean(axis=1)
        return Planes(outward_normals=hull.equations[:, :3], offsets=-hull.equations[:, 3], middles=middles)

    @cached_property
    def _length(self) -> float:
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))


def edge_distances(corners: Floats, normal: Floats, points: Floats) -> Floats:
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


def _nearest_in_polygon(corners: Floats, normal: Floats, point: Floats) -> Floats:
    """Nearest point of a convex polygon to a point of its plane, shape (3,)."""
    if (edge_distances(corners, normal, point[None]) >= 0).all():
        return point
    edges = np.roll(corners, -1, axis=0) - corners
    along = ((point - corners) * edges).sum(axis=1) / (edges * edges).sum(axis=1)
    feet = corners + np.clip(along, 0, 1)[:, None] * edges
    return feet[norm(feet - point).argmin()]
