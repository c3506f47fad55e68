"""The planes of a convex polyhedron's facets: how deep a point lies below the nearest, of few facets or of 200,000.

A point p lies o_k - n_k . p below plane k, so the nearest plane is that whose a_k = (n_k, -o_k) has the largest inner
product with x = (p, 1). Few planes are all asked. Of many it is the nearest neighbour of (x, 0) among the
(a_k, sqrt(max |a|^2 - |a_k|^2)), because these are equally long: a k-d tree finds it without asking the others, and
the fastest if x is as long as they are.

Source: Bachrach et al., Speeding up the Xbox recommender system using a Euclidean transformation for inner-product
spaces (2014).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from planner.objects.vectors import norm

MOST_ASKED = 4096
"""With more planes than these the nearest is looked up, not asked for among all."""

CHUNK = 4096
"""Points compared with all planes at once: bounds the memory."""

ROUNDING = 1e-14
"""Of squared distances in the tree, whose points have lengths of about one."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Planes:
    """The planes n_k . p = o_k of the facets."""

    normals: np.ndarray
    """Outward unit normals, shape (planes, 3)."""

    offsets: np.ndarray
    """Distances from the origin along the normals, shape (planes,) [m]."""

    middle: np.ndarray
    """A point amid the polyhedron, shape (3,) [m]."""

    length: float
    """Of the polyhedron [m]."""

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How far each point, shape (n, 3), lies below the nearest plane, negative above one, shape (n,) [m]."""
        if not len(points):
            return np.zeros(0)
        if len(self.offsets) <= MOST_ASKED:
            return np.concatenate([self._below(chunk).min(axis=1) for chunk in _chunks(points)])
        nearest = self._tree.query(self._lifted(points))[1]
        return self.offsets[nearest] - (points * self.normals[nearest]).sum(axis=1)

    def nearest(self, points: np.ndarray, tie: float) -> np.ndarray:
        """The first of the planes below which each point lies by at most `tie` [m] more than the least, shape (n,)."""
        if not len(points):
            return np.zeros(0, dtype=int)
        if len(self.offsets) <= MOST_ASKED:
            return np.concatenate([_first(self._below(chunk), tie) for chunk in _chunks(points)])
        lifted, limits = self._lifted(points), self.depth(points) + tie
        distances, _ = self._tree.query(lifted)
        wider = 2 * norm(lifted) * tie / self.length  # x was at least 1 long before it was scaled
        around = self._tree.query_ball_point(lifted, np.sqrt(distances**2 + wider + ROUNDING), return_sorted=True)
        first = np.empty(len(points), dtype=int)
        for point, near in enumerate(around):
            below = self.offsets[near] - self.normals[near] @ points[point]
            first[point] = near[int((below <= limits[point] + ROUNDING * self.length).argmax())]
        return first

    def _below(self, points: np.ndarray) -> np.ndarray:
        """How far each point lies below each plane, shape (n, planes) [m]."""
        return self.offsets - points @ self.normals.T

    @cached_property
    def _tree(self) -> cKDTree:
        """The planes as equally long vectors, with lengths in units of the polyhedron's."""
        planes = np.column_stack([self.normals, (self.normals @ self.middle - self.offsets) / self.length])
        squares = (planes * planes).sum(axis=1)
        return cKDTree(np.column_stack([planes, np.sqrt(squares.max() - squares)]))

    def _lifted(self, points: np.ndarray) -> np.ndarray:
        """The points as vectors as long as the planes in the tree, shape (n, 5)."""
        lifted = np.column_stack([(points - self.middle) / self.length, np.ones(len(points)), np.zeros(len(points))])
        return lifted * (norm(self._tree.data[0]) / norm(lifted))[:, None]


def _first(below: np.ndarray, tie: float) -> np.ndarray:
    return (below <= below.min(axis=1, keepdims=True) + tie).argmax(axis=1)


def _chunks(points: np.ndarray) -> list[np.ndarray]:
    return [points[start : start + CHUNK] for start in range(0, len(points), CHUNK)]
