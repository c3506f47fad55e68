"""Edges of a surface that one would draw: where it turns sharply, not the seams of its triangles."""

import numpy as np

from planner.objects.vectors import unit

DECIMALS = 10
"""To which coordinates in metres must agree to be the same corner."""

SHARP = np.cos(np.deg2rad(25))
"""Edges between triangles whose normals differ less are seams of a curved or flat surface."""


def sharp_edges(triangles: np.ndarray) -> np.ndarray:
    """Edges where the surface turns by more than 25 degrees or ends, shape (edges, 2, 3) [m].

    Args:
        triangles: Triangles of the surface, shape (triangles, 3, 3) [m], all with the same orientation.
    """
    normals = unit(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]))
    waiting: dict[frozenset[tuple[float, ...]], tuple[np.ndarray, np.ndarray]] = {}
    sharp = []
    for triangle, normal in zip(triangles, normals, strict=True):
        for start, stop in ((0, 1), (1, 2), (2, 0)):
            edge = triangle[[start, stop]]
            key = frozenset(tuple(corner) for corner in (np.round(edge, DECIMALS) + 0.0).tolist())
            if key not in waiting:
                waiting[key] = edge, normal
                continue
            _, other = waiting.pop(key)
            if normal @ other < SHARP:
                sharp.append(edge)
    ends = [edge for key, (edge, _) in waiting.items() if len(key) == 2]
    return np.array(sharp + ends).reshape(-1, 2, 3)
