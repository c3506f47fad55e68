"""Force and moment bounded each on its own: the paper's Cases I and II."""

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension
from planner.errors import TaskError
from planner.wrench_sets.circumscribed import circumscribed_ball
from planner.wrench_sets.values import size, space_dimension


class WrenchCylinder(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { (f, m) : |f| <= F, |m| <= M }.

    In the plane a disc times an interval, by default the paper's polyhedron of 8 sides and 2 caps; in space
    a ball times a ball, by default an icosahedron of forces times an octahedron of moments, 72 vertices.

    Raises:
        TaskError: On negative or non-finite sizes, both zero, or a dimension other than 2 and 3.
    """

    force: float
    """F, the largest force [N]."""

    moment: float
    """M, the largest moment [N m]."""

    dimension: int = 3
    """d: 2 for the plane, 3 for space."""

    force_facets: int | None = None
    """Facets of the polytope around the forces; 8 in the plane and 20 in space where left out."""

    moment_facets: int | None = None
    """Facets of the polytope around the moments; 2 in the plane and 8 in space where left out."""

    def __post_init__(self) -> None:
        if size("force", self.force, zero=True) == size("moment", self.moment, zero=True) == 0:
            raise TaskError("the cylinder is the zero wrench alone: give a force or a moment that is not zero")
        space_dimension(self.dimension)

    def vertices(self) -> Floats:
        """Every pair of a force vertex and a moment vertex, shape (l, D)."""
        forces = _around(self.force, self.dimension, self.force_facets)
        moment_dimension = wrench_dimension(self.dimension) - self.dimension
        octahedron = moment_dimension == 3 and self.moment_facets is None
        moments = _around(self.moment, moment_dimension, 8 if octahedron else self.moment_facets)
        return np.hstack([np.repeat(forces, len(moments), axis=0), np.tile(moments, (len(forces), 1))])

    def support(self, directions: Floats) -> Floats:
        """F |u_f| + M |u_m|, shape (k,)."""
        forces, moments = directions[:, : self.dimension], directions[:, self.dimension :]
        return np.linalg.norm(self.force * forces, axis=1) + np.linalg.norm(self.moment * moments, axis=1)


def _around(radius: float, dimension: int, facets: int | None) -> Floats:
    return radius * circumscribed_ball(dimension, facets) if radius else np.zeros((1, dimension))
