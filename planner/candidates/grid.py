"""Candidates on a regular grid of each planar facet.

The grid's axes are u, the body axis most perpendicular to the facet projected into it, and v = n x u. Along each
axis the facet's extent is cut into round(extent / spacing) cells, and the centres that lie inside the facet count.
"""

import numpy as np

from planner.arrays import Floats
from planner.candidates.candidates import Candidates, candidates_at
from planner.candidates.even import MOST_CANDIDATES
from planner.errors import CandidateError
from planner.objects.graspable import Graspable
from planner.objects.parts.polyhedron import Polyhedron, edge_distances
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.coincident import finger_parts
from planner.objects.surface.exposure import reachable
from planner.objects.surface.projection import project
from planner.objects.vectors import unit

STRICTLY_INSIDE = 1e-6
"""Least distance of a centre from the facet's edges, relative to the object's size."""


def grid_candidates(
    rigid_object: RigidObject, spacing: float, friction: float | None, fingertip: float | None = None
) -> Candidates:
    """Cell centres of every facet, part by part and facet by facet; those inside other parts are left out.

    Args:
        rigid_object: The object; all its parts that fingers may touch must be polyhedra.
        spacing: Wanted edge length of the cells [m].
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        fingertip: Radius of the ball that must fit beside other parts [m]; by default a share of the object's size.

    Raises:
        CandidateError: If the spacing is not positive, gives too many points or none, or a part is curved.
    """
    check_spacing(rigid_object, spacing)
    facets = []
    for index in finger_parts(rigid_object):
        part = rigid_object.parts[index]
        if not isinstance(part, Polyhedron):
            raise CandidateError(
                f"a grid needs planar facets, but geom '{part.geom}' is a {type(part).__name__.lower()}; "
                "give a number of evenly spread candidates instead"
            )
        facets += [(index, facet, _Grid(part, facet, spacing)) for facet in range(len(part.polygons))]
    cells = sum(float(np.prod(grid.cells)) for _, _, grid in facets)
    if cells > MOST_CANDIDATES:
        raise too_fine(rigid_object, spacing)
    centers = [grid.centers(STRICTLY_INSIDE * rigid_object.size) for _, _, grid in facets]
    counts = [len(each) for each in centers]
    part_of = np.repeat([index for index, _, _ in facets], counts)
    facet_of = np.repeat([facet for _, facet, _ in facets], counts)
    points, normals = project(rigid_object, np.concatenate(centers), part_of, facet_of)
    outside = reachable(rigid_object, points, normals, part_of, fingertip)
    if not outside.any():
        raise CandidateError(f"no cell centre of a grid of {spacing:g} m lies on the surface; choose a smaller spacing")
    return candidates_at(rigid_object, points[outside], part_of[outside], facet_of[outside], friction)


def check_spacing(rigid_object: Graspable, spacing: float) -> None:
    """Refuse a spacing that is not positive, or so small that counting its cells could overflow.

    Raises:
        CandidateError: If it is.
    """
    if not (np.isfinite(spacing) and spacing > 0):
        raise CandidateError(f"the grid's spacing is {spacing}; it must be positive and finite, in metres")
    if rigid_object.size > MOST_CANDIDATES * spacing:
        raise too_fine(rigid_object, spacing)


def too_fine(rigid_object: Graspable, spacing: float) -> CandidateError:
    """The error of a spacing that gives too many cells."""
    return CandidateError(
        f"a spacing of {spacing:g} m gives more than {MOST_CANDIDATES} cells; "
        f"the object is {rigid_object.size:.3g} m long, choose a larger spacing"
    )


class _Grid:
    """The cells of one facet."""

    def __init__(self, part: Polyhedron, facet: int, spacing: float) -> None:
        self.outward = part.outward_normals[facet]
        self.corners = part.vertices[part.polygons[facet]]
        axis = np.eye(3)[np.abs(np.round(self.outward, 9)).argmin()]
        u = unit(axis - (axis @ self.outward) * self.outward)
        self.axes = np.stack([u, np.cross(self.outward, u)])
        in_plane = self.corners @ self.axes.T
        self.start, self.extent = in_plane.min(axis=0), np.ptp(in_plane, axis=0)
        self.cells = np.maximum(1.0, np.floor(self.extent / spacing + 0.5))

    def centers(self, margin: float) -> Floats:
        """Cell centres farther than `margin` inside the facet's edges, shape (n, 3) [m]."""
        along_u, along_v = (
            start + (np.arange(int(cells)) + 0.5) * extent / cells
            for start, extent, cells in zip(self.start, self.extent, self.cells, strict=True)
        )
        in_plane = np.stack(np.meshgrid(along_u, along_v, indexing="ij"), axis=-1).reshape(-1, 2)
        points = in_plane @ self.axes + (self.corners[0] @ self.outward) * self.outward
        inside = (edge_distances(self.corners, self.outward, points) > margin).all(axis=1)
        return points[inside]
