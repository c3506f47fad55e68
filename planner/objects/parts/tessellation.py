"""Triangles whose corners lie on the unit sphere or the unit circle.

Refined by bisection: square roots round alike on every platform, sines and cosines do not.
"""

import numpy as np

from planner.arrays import Floats
from planner.objects.vectors import norm, unit

BISECTIONS = 3
"""Each quarter of a circle is cut into 2^BISECTIONS arcs: chords stay within 0.5 % of the radius."""


def quarter(triangles: Floats) -> Floats:
    """Cut each triangle into four at the middles of its edges, shape (4 triangles, 3, 3); winding is kept."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(corners, axis=1) for corners in quarters])


def halve(triangles: Floats) -> Floats:
    """Cut each triangle into two at the middle of its longest edge, shape (2 triangles, 3, 3); winding is kept."""
    longest = norm(np.roll(triangles, -1, axis=1) - triangles).argmax(axis=1)
    corners = (longest[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, corners[:, :, None], axis=1).transpose(1, 0, 2)
    middle = (a + b) / 2
    return np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])


def unit_sphere() -> Floats:
    """The octahedron's eight faces, refined; none crosses a coordinate plane, shape (triangles, 3, 3)."""
    x, y, z = np.eye(3)
    upper = [(x, y, z), (y, -x, z), (-x, -y, z), (-y, x, z)]
    lower = [(b, a, -c) for a, b, c in upper]
    triangles = np.array(upper + lower)
    for _ in range(BISECTIONS):
        triangles = unit(quarter(triangles))
    return triangles


def unit_circle() -> Floats:
    """Counter-clockwise corners of a regular polygon, the first at angle zero, shape (corners, 2)."""
    corners = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    for _ in range(BISECTIONS):
        middles = unit(corners + np.roll(corners, -1, axis=0))
        corners = np.stack([corners, middles], axis=1).reshape(-1, 2)
    return corners


def unit_tube() -> Floats:
    """Side of the cylinder of radius 1 over |z| <= 1, two triangles per chord, shape (triangles, 3, 3)."""
    ring = unit_circle()
    low, high = (np.column_stack([ring, np.full(len(ring), z)]) for z in (-1.0, 1.0))
    low_next, high_next = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
    return np.concatenate([np.stack([low, low_next, high_next], 1), np.stack([low, high_next, high], 1)])


def unit_disc() -> Floats:
    """The unit disc at z = 0 seen from +z, fanned about its centre, shape (triangles, 3, 3)."""
    ring = np.column_stack([unit_circle(), np.zeros(len(unit_circle()))])
    return np.stack([np.zeros_like(ring), ring, np.roll(ring, -1, axis=0)], axis=1)
