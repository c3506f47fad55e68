"""Edges of a surface that one would draw: where it turns sharply, not the seams of its triangles."""

import numpy as np

from planner.arrays import Floats
from planner.objects.vectors import unit

DECIMALS = 10
"""To which coordinates in metres must agree to be the same corner."""

SHARP = np.cos(np.deg2rad(25))
"""Edges between triangles whose normals differ less are seams of a curved or flat surface."""


def sharp_edges(triangles: Floats) -> Floats:
    """Edges where the surface turns by more than 25 degrees or ends, shape (edges, 2, 3) [m].

    Args:
        triangles: Triangles of the surface, shape (triangles, 3, 3) [m], all with the same orientation.
    """
    normals = unit(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]))
    edges = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2, 3)
    rounded = np.round(edges.reshape(-1, 3), DECIMALS) + 0.0
    corners = np.unique(rounded, axis=0, return_inverse=True)[1].reshape(-1, 2)
    _, edge_of, shared = np.unique(np.sort(corners, axis=1), axis=0, return_inverse=True, return_counts=True)
    together = np.argsort(edge_of.ravel(), kind="stable")
    turn = np.arange(len(edges)) - np.repeat(shared.cumsum() - shared, shared)  # which triangle of its edge each is
    second = np.flatnonzero(turn % 2 == 1)
    lasting = (turn % 2 == 0) & (turn == np.repeat(shared, shared) - 1)
    one, other = together[second - 1], together[second]
    turned = (normals[one // 3] * normals[other // 3]).sum(axis=1) < SHARP
    ends = together[lasting]
    ends = ends[corners[ends, 0] != corners[ends, 1]]
    return edges[np.concatenate([np.sort(other[turned]), np.sort(ends)])]
