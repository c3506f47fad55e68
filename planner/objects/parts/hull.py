"""Facets of a convex hull, coplanar triangles merged into one polygon.

MuJoCo keeps mesh vertices in single precision, so the corners of a flat face lie about 1e-7 of the size off
one plane. Everything within MERGE_TOLERANCE of a plane is therefore one facet. Vertices, polygons and
facets come in an order that depends on the geometry alone, not on how qhull happened to triangulate.
"""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull, QhullError

from planner.arrays import Floats, Indices, Mask
from planner.errors import ObjectError
from planner.millimetres import in_mm

MERGE_TOLERANCE = 1e-6
"""Largest distance of a facet's corners from its plane, relative to the diagonal of the vertices' bounding box."""

LEAST_THICKNESS = 1e-5
"""A hull thinner than this, relative to the same diagonal, has no meaningful faces."""


CHUNK = 64
"""Planes compared with all corners at once: bounds the memory, and is fast."""

MOST_COMPARED = 4096
"""With more triangles than these, only neighbours are asked whether they are coplanar."""


class Facets(NamedTuple):
    """The surface of a convex polyhedron."""

    vertices: Floats
    """Corners, shape (corners, 3) [m]."""

    polygons: tuple[Indices, ...]
    """For each facet the indices of its corners, counter-clockwise seen from outside."""

    outward_normals: Floats
    """Unit normals, shape (facets, 3)."""

    offsets: Floats
    """Distances of the facets' planes from the origin along their normals, shape (facets,) [m]."""


def convex_facets(vertices: Floats, geom: str) -> Facets:
    """Corners and facets of the convex hull of some points.

    Args:
        vertices: Shape (n, 3) [m]; repeated and interior points are allowed.
        geom: Name used in messages.

    Raises:
        ObjectError: If a coordinate is not finite or the points are (nearly) coplanar.
    """
    if not np.isfinite(vertices).all():
        raise ObjectError(f"geom '{geom}' has a vertex that is not finite; repair its mesh")
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    scaled = _canonical((vertices - middle) / (diagonal or 1.0))
    try:
        hull = ConvexHull(scaled)
    except (QhullError, ValueError) as error:
        raise ObjectError(f"the convex hull of geom '{geom}' is degenerate: its vertices span no volume") from error
    normals, offsets = hull.equations[:, :3], -hull.equations[:, 3]
    thickness = _thickness(scaled, normals, offsets)
    if thickness < LEAST_THICKNESS:
        raise ObjectError(
            f"geom '{geom}' is flat: its hull is {in_mm(thickness * diagonal, 2)} mm thick and {in_mm(diagonal, 2)} mm "
            f"long; a collision geom must be thicker than {LEAST_THICKNESS:g} of its length"
        )
    polygons = _outlines(scaled, hull)
    planes = _planes(scaled, polygons)
    order = np.lexsort(np.round(planes, 6).T[::-1])
    used, corners = np.unique(np.concatenate([polygons[facet] for facet in order]), return_inverse=True)
    ends = np.cumsum([len(polygons[facet]) for facet in order])
    normals = planes[order, :3]
    return Facets(
        vertices=scaled[used] * diagonal + middle,
        polygons=tuple(np.split(corners, ends[:-1])),
        outward_normals=normals,
        offsets=planes[order, 3] * diagonal + normals @ middle,
    )


def _canonical(points: Floats) -> Floats:
    """Points sorted by their rounded coordinates, repeated ones kept once."""
    rounded = np.round(points, 9) + 0.0  # turns -0 into 0
    _, first = np.unique(rounded, axis=0, return_index=True)
    return points[first]


def _thickness(points: Floats, normals: Floats, offsets: Floats) -> float:
    """Least width of a hull along its facets' normals, or a lower bound of it that is thick enough.

    The largest ball inside about the mean corner is such a bound; only of a thin hull all corners are asked.
    """
    ball = 2 * float((offsets - normals @ points.mean(axis=0)).min())
    if ball >= LEAST_THICKNESS:
        return ball
    chunks = (slice(start, start + CHUNK) for start in range(0, len(offsets), CHUNK))
    return float(min((offsets[some] - (points @ normals[some].T).min(axis=0)).min() for some in chunks))


def _outlines(points: Floats, hull: ConvexHull) -> list[Indices]:
    """Corners of each facet, counter-clockwise seen from outside."""
    triangles, normals = hull.simplices, hull.equations[:, :3]
    first, second, third = (points[triangles[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(second - first, third - first), axis=1)
    largest_first = np.argsort(-areas, kind="stable")
    clusters = _clusters(points, hull)[largest_first]
    together = largest_first[np.argsort(clusters, kind="stable")]
    sizes = np.bincount(clusters)
    single = np.repeat(sizes == 1, sizes)
    outlines = list(_triangles(points, np.sort(triangles[together[single]], axis=1), normals[together[single]]))
    pairs = together[np.repeat(sizes == 2, sizes)].reshape(-1, 2)
    plain, quadrangles = _quadrangles(points, triangles[pairs], hull.equations[pairs])
    outlines.extend(quadrangles)
    several = sizes > 1
    several[sizes == 2] = ~plain
    left = together[np.repeat(several, sizes)]
    for cluster in np.split(left, sizes[several].cumsum()[:-1]) if len(left) else []:
        for corners, normal in _coplanar_groups(points, triangles[cluster], hull.equations[cluster]):
            outlines.append(_polygon(points, corners, normal))
    return [outline for outline in outlines if len(outline) >= 3]


def _clusters(points: Floats, hull: ConvexHull) -> Indices:
    """Number of the cluster of each triangle, shape (triangles,); coplanar ones are in the same cluster.

    Of few triangles all are in one. Of many, a cluster is what neighbours that are coplanar hold together: by convexity
    coplanar triangles are in one piece.
    """
    triangles, neighbours, count = hull.simplices, hull.neighbors, len(hull.simplices)
    if count <= MOST_COMPARED:
        return np.zeros(count, dtype=int)
    normals, offsets = hull.equations[:, :3], -hull.equations[:, 3]
    heights = np.einsum("tncd,td->tnc", points[triangles[neighbours]], normals) - offsets[:, None, None]
    alike = np.einsum("tnd,td->tn", normals[neighbours], normals) > 0
    triangle, side = np.nonzero((np.abs(heights) <= MERGE_TOLERANCE).all(axis=2) & alike)
    pairs = (np.ones(len(triangle), dtype=bool), (triangle, neighbours[triangle, side]))
    labels: Indices = connected_components(coo_array(pairs, shape=(count, count)), directed=False)[1]
    return labels


def _quadrangles(points: Floats, pairs: Indices, planes: Floats) -> tuple[Mask, Indices]:
    """Pairs of neighbouring triangles that are one convex quadrangle each beyond doubt, all at once.

    The second triangle is flush with the first, and each corner is farther than MERGE_TOLERANCE from the line through
    any two others, so that `_coplanar_groups` and `_polygon` would find the same.

    Args:
        points: Shape (n, 3).
        pairs: Indices of their corners, the larger triangle first, shape (pairs, 2, 3).
        planes: Outward unit normal and negative offset of each triangle, shape (pairs, 2, 4).

    Returns:
        Which pairs are, shape (pairs,), and the outlines of those, from the first corner on, shape (quadrangles, 4).
    """
    normals, everyone = planes[:, 0, :3], np.arange(len(pairs))
    first, second = _triangles(points, pairs[:, 0], normals), pairs[:, 1]
    shared = first[:, :, None] == second[:, None]
    start, opposite = shared.any(axis=2).argmin(axis=1), second[everyone, shared.any(axis=1).argmin(axis=1)]
    before, after = first[everyone, (start + 2) % 3], first[everyone, (start + 1) % 3]
    outlines = np.column_stack([first[everyone, start], after, opposite, before])
    corners = points[outlines]
    heights = np.einsum("pd,pd->p", points[opposite], normals) + planes[:, 0, 3]
    flush = (np.abs(heights) <= MERGE_TOLERANCE) & ((normals * planes[:, 1, :3]).sum(axis=1) > 0)
    edges = np.roll(corners, -1, axis=1) - corners
    areas = np.einsum("pcd,pd->pc", np.cross(edges, np.roll(edges, -1, axis=1)), normals)
    lengths = np.linalg.norm(edges, axis=2).sum(axis=1) / 2  # no two corners are farther apart
    convex = (areas > MERGE_TOLERANCE * lengths[:, None]).all(axis=1)
    plain = flush & convex
    turns = outlines[plain].argmin(axis=1)[:, None] + np.arange(4)
    return plain, np.take_along_axis(outlines[plain], turns % 4, axis=1)


def _coplanar_groups(points: Floats, triangles: Indices, planes: Floats) -> list[tuple[Indices, Floats]]:
    """Point indices and outward normal of each facet, gathered about the largest triangle not yet taken.

    Args:
        points: Shape (n, 3).
        triangles: Indices of their corners, the largest triangle first, shape (triangles, 3).
        planes: Outward unit normal and negative offset of each, shape (triangles, 4).
    """
    corners, triangles = np.unique(triangles, return_inverse=True)
    points, triangles = points[corners], triangles.reshape(-1, 3)
    normals, offsets = planes[:, :3], -planes[:, 3]
    free = np.ones(len(triangles), dtype=bool)
    groups = []
    for seeds in np.split(np.arange(len(triangles)), range(CHUNK, len(triangles), CHUNK)):
        seeds = seeds[free[seeds]]
        on_plane = np.abs(points @ normals[seeds].T - offsets[seeds]) <= MERGE_TOLERANCE
        alike = on_plane[triangles].all(axis=1) & (normals @ normals[seeds].T > 0)
        for seed, flush in zip(seeds, alike.T, strict=True):
            if free[seed]:
                group = free & flush
                group[seed] = True
                free &= ~group
                groups.append((corners[np.unique(triangles[group])], normals[seed]))
    return groups


def _triangles(points: Floats, corners: Indices, normals: Floats) -> Indices:
    """Triangles, corners of shape (n, 3), made counter-clockwise about their normals, from the first corner on."""
    first, second, third = points[corners].transpose(1, 0, 2)
    clockwise = np.linalg.det(np.stack([first - third, second - third, normals], axis=1)) <= 0
    return np.where(clockwise[:, None], corners[:, [0, 2, 1]], corners)


def _polygon(points: Floats, corners: Indices, normal: Floats) -> Indices:
    """Convex outline of coplanar points, counter-clockwise about `normal`, from the first corner on.

    Andrew's monotone chain; points within MERGE_TOLERANCE of an edge are not corners.
    """
    if len(corners) == 3:
        outline: Indices = _triangles(points, corners[None], normal[None])[0]
        return outline
    first_axis = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    axes = np.stack([first_axis, np.cross(normal, first_axis)])
    plane_points = points[corners] @ axes.T / np.linalg.norm(first_axis)
    order = np.lexsort(plane_points.T[::-1])
    chain = [*_half_outline(plane_points, order), *_half_outline(plane_points, order[::-1])]
    start = chain.index(min(chain))
    return corners[chain[start:] + chain[:start]]


def _half_outline(points: Floats, order: Indices) -> list[int]:
    """Corners on the right of the way from the first point to the last, without the last."""
    chain: list[int] = []
    for index in order:
        while len(chain) >= 2:
            edge, step = points[index] - points[chain[-2]], points[chain[-1]] - points[chain[-2]]
            if step[0] * edge[1] - step[1] * edge[0] > MERGE_TOLERANCE * np.hypot(*edge):
                break
            chain.pop()
        chain.append(int(index))
    return chain[:-1]


def _planes(points: Floats, polygons: list[Indices]) -> Floats:
    """Outward unit normal and offset of nearly flat polygons, from their vector areas (Newell), shape (n, 4).

    Polygons with equally many corners are done together.
    """
    planes = np.empty((len(polygons), 4))
    counts = np.array([len(polygon) for polygon in polygons])
    for count in np.unique(counts):
        chosen = np.flatnonzero(counts == count)
        corners = points[np.stack([polygons[index] for index in chosen])]
        middles = corners.mean(axis=1)
        arms = corners - middles[:, None]
        areas = np.cross(arms, np.roll(arms, -1, axis=1)).sum(axis=1)
        normals = areas / np.linalg.norm(areas, axis=1, keepdims=True)
        planes[chosen] = np.column_stack([normals, (normals * middles).sum(axis=1)])
    return planes
