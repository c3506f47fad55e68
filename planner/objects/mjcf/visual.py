"""How far the object that is seen lies from the object that MuJoCo collides.

Random points of the visual meshes are compared with the outer collision surface. The distance found is that to some
point of it: exact on open faces, and up to a percent of the object's size too large beside hidden ones.
Frame: body frame B, SI.
"""

import logging
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from planner.arrays import Floats, Indices, Mask
from planner.millimetres import in_mm, point_in_mm
from planner.objects.mjcf.compiled import CompiledObject, compile_object
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.exposure import exposed
from planner.objects.surface.nearest import nearest_on_triangles
from planner.objects.surface.projection import project
from planner.objects.surface.sampling import random_points, whole_surface
from planner.objects.vectors import norm

logger = logging.getLogger(__name__)

LARGE = 0.02
"""A 95th percentile above this share of the object's size deserves a warning."""

SEEN, TOUCHED = 1000, 10_000
"""Random points of the visual meshes, and of the parts' surfaces."""

TOUCHING = 1e-6
"""Distance of a part within which a point is on its surface, relative to the object's size."""

NO_PART = -1
"""In place of a part's number."""

NEIGHBOURS = 8
"""Triangles near a visual point that are asked for their own nearest point."""


@dataclass(frozen=True, eq=False, kw_only=True)
class VisualDifference:
    """Distances from the visual meshes to the collision surface."""

    typical: float
    """95th percentile over the visual surface [m]."""

    largest: float
    """[m]"""

    where: Floats
    """The visual point farthest from the collision surface, shape (3,) [m]."""

    size: float
    """Of the object [m]."""

    @property
    def large(self) -> bool:
        """Whether what is seen is hardly what is grasped."""
        return self.typical > LARGE * self.size

    def __str__(self) -> str:
        return (
            f"{in_mm(self.typical, 2)} mm ({self.typical / self.size:.1%} of the size) off the collision surface at "
            f"the 95th percentile, at most {in_mm(self.largest, 2)} mm, at {point_in_mm(self.where)} mm"
        )


def visual_difference(rigid_object: RigidObject) -> VisualDifference | None:
    """Compare the object's visual meshes, or else its colliding meshes before hulls are taken, with what collides.

    Args:
        rigid_object: The object; its file is compiled again.

    Returns:
        None for an object without meshes, or with none that shows.

    Raises:
        ObjectError: If the file cannot be compiled any more.
    """
    compiled = compile_object(rigid_object.source)
    triangles = seen_triangles(compiled)
    if not len(triangles):
        return None
    generator = np.random.Generator(np.random.PCG64(0))
    points, index = random_points(triangles, SEEN, generator)
    points = points[~_buried(rigid_object, points, _parts_of_seen(compiled)[index])]
    if not len(points):
        return None
    distances = _distances(rigid_object, points, generator)
    worst = int(distances.argmax())
    return VisualDifference(
        typical=float(np.percentile(distances, 95)),
        largest=float(distances[worst]),
        where=points[worst],
        size=rigid_object.size,
    )


def warn_of_difference(rigid_object: RigidObject, difference: VisualDifference | None) -> None:
    """Log a warning when what is seen is hardly what is grasped."""
    if difference is not None and difference.large:
        logger.warning("the visual mesh of body '%s' is %s", rigid_object.body, difference)


def seen_triangles(compiled: CompiledObject) -> Floats:
    """Triangles of the meshes that are seen and do not collide, or else of those that do, shape (n, 3, 3) [m]."""
    meshes = compiled.meshes(colliding=False) or compiled.meshes(colliding=True)
    found = [vertices[faces] for vertices, faces in map(compiled.mesh, meshes)]
    return np.concatenate([*found, np.zeros((0, 3, 3))])


def _parts_of_seen(compiled: CompiledObject) -> Indices:
    """The part as which each of the seen triangles collides, shape (n,); NO_PART where its mesh is only seen."""
    if compiled.meshes(colliding=False):
        return np.full(len(seen_triangles(compiled)), NO_PART)
    meshes = compiled.meshes(colliding=True)
    parts = [compiled.colliding.index(geom) for geom in meshes]
    return np.repeat(parts, [len(compiled.mesh(geom)[1]) for geom in meshes])


def _buried(rigid_object: RigidObject, points: Floats, own: Indices) -> Mask:
    """Which points of meshes that collide lie in or on another part than their own, where nobody sees them, shape (n,).

    Args:
        rigid_object: The object.
        points: Shape (n, 3) [m].
        own: Part of each, or NO_PART, shape (n,).
    """
    inside = np.zeros(len(points), dtype=bool)
    for number, part in enumerate(rigid_object.parts):
        asked = np.flatnonzero((own != number) & (own != NO_PART))
        inside[asked] |= part.depth(points[asked]) > -TOUCHING * rigid_object.size
    return inside


def _distances(rigid_object: RigidObject, points: Floats, generator: np.random.Generator) -> Floats:
    """To the outer surface, shape (n,) [m]: to the triangles on which the nearest of many random points lie."""
    triangles, part, facet = whole_surface(rigid_object)
    drawn, index = random_points(triangles, TOUCHED, generator)
    if len(triangles) > TOUCHED:  # few of them have a random point
        drawn = np.concatenate([drawn, triangles.mean(axis=1)])
        index = np.concatenate([index, np.arange(len(triangles))])
    drawn, normals = project(rigid_object, drawn, part[index], facet[index])
    outside = exposed(rigid_object, drawn, normals, part[index])
    nearest, neighbours = cKDTree(drawn[outside]).query(points, k=NEIGHBOURS)
    near = index[outside][neighbours.ravel()]
    repeated = np.repeat(points, NEIGHBOURS, axis=0)
    feet, normals = project(rigid_object, nearest_on_triangles(triangles[near], repeated), part[near], facet[near])
    hidden = ~exposed(rigid_object, feet, normals, part[near])
    to_feet = np.where(hidden, np.inf, norm(feet - repeated)).reshape(neighbours.shape)
    return np.minimum(to_feet.min(axis=1), nearest[:, 0])
