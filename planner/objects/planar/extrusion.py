"""A planar object as a slab: its outline swept from -thickness / 2 to thickness / 2 along z.

A concave outline becomes one slab per triangle of it, because parts in space are convex.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.planar.ear_clipping import is_convex, triangles
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.planar.simple_polygon import cross
from planner.objects.rigid_object import RigidObject


@dataclass(frozen=True, eq=False, kw_only=True)
class Slab(RigidObject):
    """A planar object in space: it moves in the plane z = 0 and turns about z, nothing else."""

    @property
    def in_plane(self) -> bool:
        """Always."""
        return True


def extruded(planar: PlanarObject) -> Slab:
    """The slab of a planar object, its body frame that of the outline.

    Raises:
        ObjectError: If the outline is too thin somewhere to be a solid.
    """
    outline, half = planar.outline, planar.thickness / 2
    pieces = [outline.corners]
    if not is_convex(outline.corners):
        pieces = [outline.corners[list(triangle)] for triangle in triangles(outline.corners)]
    slabs = [np.vstack([np.column_stack([piece, np.full(len(piece), z)]) for z in (-half, half)]) for piece in pieces]
    return Slab(
        source=planar.source,
        sha256=planar.sha256,
        body=planar.body,
        parts=tuple(Polyhedron.hull(slab, geom=outline.geom, friction=outline.friction) for slab in slabs),
        mass=planar.mass,
        center_of_mass=np.append(planar.center_of_mass, 0.0),
        inertia=_inertia(planar),
        extent=np.append(planar.extent, planar.thickness),
    )


def _inertia(planar: PlanarObject) -> Floats:
    """Of the uniform slab about its centre of mass, shape (3, 3) [kg m^2].

    From the mean of r r^T over the area, summed over the triangles (0, a, b) between the centre and each edge: such
    a triangle of area A contributes A / 12 (a a^T + b b^T + (a + b)(a + b)^T).
    """
    a = planar.outline.corners - planar.center_of_mass
    b = np.roll(a, -1, axis=0)
    weights = cross(a, b) / (24 * planar.outline.area)
    moments = np.zeros((3, 3))
    for arm in (a, b, a + b):
        moments[:2, :2] += np.einsum("k,ki,kj->ij", weights, arm, arm)
    moments[2, 2] = planar.thickness**2 / 12
    return planar.mass * (moments.trace() * np.eye(3) - moments)
