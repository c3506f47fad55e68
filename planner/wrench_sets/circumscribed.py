"""Polytopes that contain the unit ball, each of their facets touching it.

Any polytope { x : n_j . x <= 1 } with unit normals n_j contains the ball, because n_j . x <= |x|. Only the
spread of the normals decides how far its vertices stick out. Nothing here is random: the same request
gives the same vertices on every machine.
"""

import math
from itertools import product

import numpy as np
from scipy.spatial import HalfspaceIntersection

from planner.arrays import Floats
from planner.errors import TaskError

MAX_FACETS = 200
"""Largest number of facets: in six dimensions it already means more than ten thousand vertices."""

MAX_VERTICES = 4096
"""Largest number of vertices of a required external force set: each costs force problems."""

COINCIDENT = 9
"""Decimals to which two vertices must agree to be the same one."""


def circumscribed_ball(dimension: int, facets: int | None = None) -> Floats:
    """Vertices of a polytope whose facets all touch the unit ball around the origin.

    A segment; a regular polygon with a flat at angle zero; the regular polyhedra of 6, 8, 12 and 20 facets;
    in any higher dimension the cube of 2k facets and the cross-polytope of 2^k. Every other even number of
    facets gets normals spread evenly in pairs n, -n.

    Args:
        dimension: k of the ball, 1 to 6.
        facets: Number of facets; nothing means 2, 8, 20 for k = 1, 2, 3 and the cross-polytope above,
            whose 2k vertices are the fewest.

    Returns:
        Shape (vertices, k).

    Raises:
        TaskError: When no such polytope exists, or it has too many facets or vertices.
    """
    if facets is None:
        facets = {1: 2, 2: 8, 3: 20}.get(dimension, 2**dimension)
    _check_facets(dimension, facets)
    if dimension == 1:
        return np.array([[-1.0], [1.0]])
    if dimension == 2:
        return _polygon(facets)
    if facets == 2 * dimension:
        return _signs(dimension)
    if facets == 2**dimension:
        return np.vstack([np.eye(dimension), -np.eye(dimension)]) * math.sqrt(dimension)
    if dimension == 3 and facets in (12, 20):
        return _golden_solid(facets)
    return _intersection(_spread_normals(dimension, facets // 2))


def _check_facets(dimension: int, facets: int) -> None:
    if dimension == 1 and facets != 2:
        raise TaskError(f"an interval has 2 ends, not {facets}: give 2, or leave the number of facets out")
    fewest = {1: 2, 2: 3}.get(dimension, 2 * dimension)
    if not fewest <= facets <= MAX_FACETS:
        raise TaskError(
            f"a polytope around a {dimension}-dimensional ball takes {fewest} to {MAX_FACETS} facets, got {facets}"
        )
    if dimension > 2 and facets % 2:
        raise TaskError(f"a polytope around a {dimension}-dimensional ball takes an even number of facets: {facets}")


def _polygon(facets: int) -> Floats:
    """Regular polygon; a flat lies on every axis when 4 divides the number of its facets."""
    angles = 2 * np.pi * (np.arange(facets) + 0.5) / facets
    return np.stack([np.cos(angles), np.sin(angles)], axis=1) / math.cos(math.pi / facets)


def _signs(dimension: int) -> Floats:
    return np.array(list(product((-1.0, 1.0), repeat=dimension)))


def _golden_solid(facets: int) -> Floats:
    """Dodecahedron or icosahedron: each one's facet normals are the other's vertices."""
    golden = (1 + math.sqrt(5)) / 2
    cyclic = [np.eye(3)[[shift, (shift + 1) % 3, (shift + 2) % 3]] for shift in range(3)]
    signs = np.array(list(product((0.0,), (-1.0, 1.0), (-1.0, 1.0))))
    icosahedron = np.vstack([signs * (0, 1, golden) @ turn for turn in cyclic])
    dodecahedron = np.vstack([_signs(3), *(signs * (0, 1 / golden, golden) @ turn[::-1] for turn in cyclic)])
    solid, normals = (icosahedron, dodecahedron) if facets == 20 else (dodecahedron, icosahedron)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return solid / float((normals @ solid.T).max())


def _spread_normals(dimension: int, pairs: int) -> Floats:
    """Unit normals, one of each pair n, -n, each as far as possible from those before; the axes first.

    The candidates are directions of small integer vectors; equal distances are decided by their order,
    and distances are rounded first so that no machine's last bit decides.
    """
    reach = {3: 5, 4: 3}.get(dimension, 2)
    lattice = np.array(list(product(range(-reach, reach + 1), repeat=dimension)), dtype=float)
    lattice = lattice[len(lattice) // 2 + 1 :]  # one half: the other is its mirror image
    pool = lattice / np.linalg.norm(lattice, axis=1, keepdims=True)
    normals = list(np.eye(dimension))
    closeness = np.abs(pool).max(axis=1)
    while len(normals) < pairs:
        farthest = pool[np.round(closeness, COINCIDENT).argmin()]
        normals.append(farthest)
        closeness = np.maximum(closeness, np.abs(pool @ farthest))
    return np.array(normals)


def _intersection(normals: Floats) -> Floats:
    """Vertices of { x : |n_j . x| <= 1 }, in the order of their coordinates."""
    both = np.vstack([normals, -normals])
    halfspaces = np.hstack([both, -np.ones((len(both), 1))])
    corners = HalfspaceIntersection(halfspaces, np.zeros(normals.shape[1])).intersections
    vertices: Floats = corners[np.unique(np.round(corners, COINCIDENT), axis=0, return_index=True)[1]]
    if len(vertices) > MAX_VERTICES:
        raise TaskError(
            f"{len(both)} facets around a {normals.shape[1]}-dimensional ball have {len(vertices)} vertices; "
            f"at most {MAX_VERTICES} are allowed: ask for fewer facets"
        )
    return vertices
