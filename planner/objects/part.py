"""A part of an object: a solid in space or an area in the plane, whose surface is divided into facets.

Frame: the object's body frame B, SI. d = 3 in space, 2 in the plane.
"""

from typing import Protocol

from planner.arrays import Floats, Indices


class Part(Protocol):
    """What candidates need of a part."""

    @property
    def geom(self) -> str:
        """The geom's name in the compiled model, or `geom<id>` where it has none; the name of a planar object."""

    @property
    def friction(self) -> float:
        """Sliding friction coefficient the part carries."""

    def bounds(self) -> Floats:
        """Lower and upper corner of the part's bounding box along the axes of B, shape (2, d) [m]."""

    def nearest_facet(self, points: Floats) -> Indices:
        """The facet nearest to each point that lies on or near the surface, shape (n,)."""

    def project(self, points: Floats, facets: Indices) -> tuple[Floats, Floats]:
        """Nearest points of the given facets' exact surface and the inward unit normals there.

        Args:
            points: Points near their facets, shape (n, d) [m].
            facets: Facet of each point, shape (n,).

        Returns:
            Surface points and inward unit normals, each of shape (n, d).
        """

    def depth(self, points: Floats) -> Floats:
        """How deep each point lies inside: positive inside, zero on the surface, negative outside [m].

        The sign is exact; the magnitude is a lower bound of the distance to the surface for points inside.
        """
