"""Distance from a point to the outer collision surface of an object: gamma of the paper's examples.

The outer surface is what `exposed` leaves of the parts' surfaces. Branch and bound over triangles: the most
promising are cut into two, and a triangle inside another convex part is dropped whole, by convexity.
"""

from functools import cached_property

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.errors import ObjectError
from planner.objects.parts.tessellation import halve
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.exposure import PROBES, exposed
from planner.objects.vectors import norm

ACCURACY = 1e-3
"""Relative error of the distance at which the search stops."""

RESOLUTION = 1e-4
"""Triangles shorter than this, relative to the object's size, are not cut."""

BATCH, MOST_BATCHES = 1024, 400
"""Triangles cut at once, and how often at most: ten times what the worst object seen took (38)."""


def surface_distance(rigid_object: RigidObject, point: Floats) -> float:
    """Distance from `point` to the nearest exposed point of the union of the parts' surfaces.

    Exact (to rounding) for a single part, and wherever the facet nearest to the point is exposed there.
    Otherwise the distance to some exposed point, at most ACCURACY too large (or RESOLUTION of the object's size,
    if that is more): this happens where the nearest point lies on a curve in which parts intersect.

    Args:
        rigid_object: The object.
        point: In B, shape (3,) [m].

    Returns:
        The distance, not negative, inside as outside [m].

    Raises:
        ObjectError: If the point is not finite, or the parts hide each other so that no exposed point is found.
    """
    if not np.isfinite(point).all():
        raise ObjectError(f"the point {point} is not finite; give a point of the body frame in metres")
    patches = _whole_surface(rigid_object)
    bounds = patches.lower_bounds(point)
    nearest = patches.least_exposed_distance(point)
    for _ in range(MOST_BATCHES):
        promising = np.flatnonzero(bounds < nearest * (1 - ACCURACY))
        if not len(promising):
            break
        promising = promising[np.argsort(bounds[promising], kind="stable")]
        children = patches.subset(promising[:BATCH]).halved()
        nearest = min(nearest, children.least_exposed_distance(point))
        children = children.subset(children.lengths() > RESOLUTION * rigid_object.size)
        children = children.subset(~children.buried())
        bounds = np.concatenate([bounds[promising[BATCH:]], children.lower_bounds(point)])
        patches = patches.subset(promising[BATCH:]).joined(children)
    if not np.isfinite(nearest):
        raise ObjectError("no exposed point was found on the object's surface; remove parts that hide each other")
    return nearest


def _whole_surface(rigid_object: RigidObject) -> "_Patches":
    surfaces = [part.triangles() for part in rigid_object.parts]
    triangles = np.concatenate([triangles for triangles, _ in surfaces])
    facets = np.concatenate([facets for _, facets in surfaces])
    return _Patches(rigid_object, triangles, facets, np.repeat(np.arange(len(surfaces)), [len(f) for _, f in surfaces]))


class _Patches:
    """Triangles with corners on the parts' surfaces, each standing for the patch of surface above it."""

    def __init__(self, rigid_object: RigidObject, triangles: Floats, facets: Indices, part: Indices) -> None:
        self.object, self.triangles, self.facets, self.part = rigid_object, triangles, facets, part

    def subset(self, chosen: Indices | Mask) -> "_Patches":
        """The patches at the given indices, or where the given mask is true."""
        return _Patches(self.object, self.triangles[chosen], self.facets[chosen], self.part[chosen])

    def joined(self, others: "_Patches") -> "_Patches":
        """These patches, then the others."""
        pairs = zip(
            (self.triangles, self.facets, self.part), (others.triangles, others.facets, others.part), strict=True
        )
        return _Patches(self.object, *(np.concatenate(pair) for pair in pairs))

    def halved(self) -> "_Patches":
        """Each triangle cut into two across its longest edge, with corners on the surface."""
        cut = _Patches(self.object, halve(self.triangles), np.tile(self.facets, 2), np.tile(self.part, 2))
        for corner in range(3):
            cut.triangles[:, corner] = cut.project(cut.triangles[:, corner])[0]
        return cut

    def least_exposed_distance(self, point: Floats) -> float:
        """Least distance of an exposed surface point found on the patches [m]; infinite if none is found.

        The nearest point of each curved facet is tried too: it is no point of a triangle.
        """
        curved = self.subset(self.bulges > 0)
        distances = [np.inf]
        for patches, starts in (
            (self, nearest_on_triangles(self.triangles, point)),
            (curved, np.broadcast_to(point, (len(curved.part), 3))),
        ):
            feet, normals = patches.project(starts)
            distances.extend(norm(feet[exposed(self.object, feet, normals, patches.part)] - point))
        return float(min(distances))

    def lower_bounds(self, point: Floats) -> Floats:
        """Distances below which no point of each patch lies, shape (triangles,) [m]."""
        bounds = norm(nearest_on_triangles(self.triangles, point) - point) - self.bulges
        curved = self.bulges > 0
        facet_feet, _ = self.subset(curved).project(np.broadcast_to(point, (int(curved.sum()), 3)))
        bounds[curved] = np.maximum(bounds[curved], norm(facet_feet - point))
        return bounds

    def lengths(self) -> Floats:
        """Longest edge of each triangle, shape (triangles,) [m]."""
        return norm(self.triangles - np.roll(self.triangles, 1, axis=1)).max(axis=1)

    def buried(self) -> Mask:
        """Whether one other part holds the whole patch, lifted to a height of `exposed`, shape (triangles,)."""
        _, normals = self.project(self.triangles.mean(axis=1))
        margin, inside = self.bulges, np.zeros(len(self.part), dtype=bool)
        for height in PROBES:
            lifted = self.triangles - height * self.object.size * normals[:, None]
            for index, other in enumerate(self.object.parts):
                depths = other.depth(lifted.reshape(-1, 3)).reshape(-1, 3).min(axis=1)
                inside |= (depths > margin) & (self.part != index)
        return inside

    @cached_property
    def bulges(self) -> Floats:
        """Twice the rise of the surface above the middle of each triangle, zero on flat facets, shape (n,) [m]."""
        middles = self.triangles.mean(axis=1)
        rises = norm(self.project(middles)[0] - middles)
        return np.where(rises > 1e-12 * self.object.size, 2 * rises, 0.0)

    def project(self, points: Floats) -> tuple[Floats, Floats]:
        """Surface points and inward normals of the triangles' facets nearest to one point each."""
        feet, normals = np.empty(points.shape), np.empty(points.shape)
        for index in np.unique(self.part):
            here = self.part == index
            feet[here], normals[here] = self.object.parts[index].project(points[here], self.facets[here])
        return feet, normals


def nearest_on_triangles(triangles: Floats, point: Floats) -> Floats:
    """Nearest point of each triangle, shape (n, 3, 3), to a point, shape (3,), or to one each, shape (n, 3).

    It is the foot on the triangle's plane or on an edge.

    Returns:
        Shape (n, 3) [m].
    """
    starts, edges = triangles, np.roll(triangles, -1, axis=1) - triangles
    squares, to = (edges * edges).sum(axis=2), point[..., None, :]
    along = ((to - starts) * edges).sum(axis=2) / np.where(squares > 0, squares, 1.0)
    on_edges = starts + np.clip(along, 0, 1)[..., None] * edges
    nearest_edge = norm(on_edges - to).argmin(axis=1)
    nearest = on_edges[np.arange(len(triangles)), nearest_edge]
    areas = np.cross(edges[:, 0], edges[:, 1])
    heights = ((point - triangles[:, 0]) * areas).sum(axis=1) / np.maximum((areas * areas).sum(axis=1), 1e-300)
    feet = point - heights[:, None] * areas
    sides = (np.cross(edges, feet[:, None] - starts) * areas[:, None]).sum(axis=2)
    return np.where(((sides >= 0).all(axis=1) & (areas != 0).any(axis=1))[:, None], feet, nearest)
