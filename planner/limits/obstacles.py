"""Convex sets that a finger must not enter, and their nearest points: parts, edges of an outline, the table.

Frame: the object's body frame B, SI; d = 3 in space, 2 in the plane.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.graspable import Graspable
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.planar.outline import Outline
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.rigid_object import ConvexPart
from planner.objects.surface.nearest import nearest_on_triangles
from planner.objects.vectors import norm


class Obstacle(Protocol):
    """A convex set."""

    def bounds(self) -> Floats:
        """Lower and upper corner of its bounding box, shape (2, d) [m]."""

    def nearest(self, point: Floats) -> Floats:
        """The point of the set nearest to `point`, shape (d,) [m]: itself where it lies inside."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Solid:
    """A part of an object in space."""

    part: ConvexPart

    def bounds(self) -> Floats:
        """See `Obstacle.bounds`."""
        return self.part.bounds()

    def nearest(self, point: Floats) -> Floats:
        """See `Obstacle.nearest`; from outside, the nearest of the nearest points of all facets."""
        if self.part.depth(point[None])[0] >= 0:
            return point
        triangles, facets = self._surface
        if isinstance(self.part, Polyhedron):  # its triangles are exact
            feet = nearest_on_triangles(triangles, point)
        else:
            feet, _ = self.part.project(np.broadcast_to(point, (len(facets), 3)), facets)
        return feet[norm(feet - point).argmin()]

    @cached_property
    def _surface(self) -> tuple[Floats, Indices]:
        """Triangles, and the numbers of the facets."""
        triangles, facets = self.part.triangles()
        return triangles, np.unique(facets)


@dataclass(frozen=True, eq=False, kw_only=True)
class Edge:
    """An edge of a planar object's outline."""

    outline: Outline

    number: int

    def bounds(self) -> Floats:
        """See `Obstacle.bounds`."""
        ends = self.outline.corners[self.number] + np.array([[0.0], [1.0]]) * self.outline.edges[self.number]
        return np.sort(ends, axis=0)

    def nearest(self, point: Floats) -> Floats:
        """See `Obstacle.nearest`."""
        return self.outline.project(point[None], np.array([self.number]))[0][0]


@dataclass(frozen=True, eq=False, kw_only=True)
class HalfSpace:
    """The points with up . p <= height."""

    up: Floats
    """Unit normal, shape (d,)."""

    height: float
    """[m]"""

    def bounds(self) -> Floats:
        """See `Obstacle.bounds`; no box is finite."""
        return np.array([[-np.inf], [np.inf]]) * np.ones(len(self.up))

    def nearest(self, point: Floats) -> Floats:
        """See `Obstacle.nearest`."""
        return point - max(0.0, float(self.up @ point) - self.height) * self.up


def obstacles(rigid_object: Graspable) -> list[Obstacle]:
    """The parts of an object in space; the edges of a planar one."""
    if isinstance(rigid_object, PlanarObject):
        outline = rigid_object.outline
        return [Edge(outline=outline, number=number) for number in range(len(outline.corners))]
    return [Solid(part=part) for part in rigid_object.parts]
