"""The planes of a convex polyhedron's facets: how deep a point lies below the nearest, of few facets or of 200,000.

A point p lies o_k - n_k . p below plane k. Few planes are all asked. Many are in blocks of neighbours, cut again and
again down to single planes, and each block is bounded by a plane j of its own: with a point q of facet j,

    o_k - n_k . p  =  (o_j - n_j . p) + (o_k - o_j - (n_k - n_j) . q) - (n_k - n_j) . (p - q)
                  >=  (o_j - n_j . p) - e - sum_i r_i |p - q|_i,

where -e is the least of the second terms and r_i the largest |n_k - n_j|_i. Only blocks are cut whose bound is not
above the least depth already found. Coordinates i are along the principal axes of the polyhedron: where it is long and
thin, a large |p - q|_i meets a small r_i, so that the bounds of a needle are as tight as those of a ball.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planner.arrays import Floats, Indices
from planner.objects.neighbour_blocks import halved
from planner.objects.vectors import norm

MOST_ASKED = 4096
"""Of more planes than these most are not asked."""

CHUNK = 4096
"""Points compared with few planes at once: bounds the memory."""

FEW = 1024
"""The same for many planes, with some blocks of which each point is compared."""

HALVINGS = 2
"""How often a block is halved before its pieces are bounded."""

PIECES = 2**HALVINGS
"""Of one block."""

ROUNDING = 1e-12
"""By how much the bounds are lower for the sake of rounding, relative to the polyhedron's size."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Planes:
    """The planes n_k . p = o_k of the facets."""

    outward_normals: Floats
    """n_k, of unit length, shape (planes, 3)."""

    offsets: Floats
    """Distances from the origin along the normals, shape (planes,) [m]."""

    middles: Floats
    """A point of each facet, shape (planes, 3) [m]."""

    def depth(self, points: Floats) -> Floats:
        """How far each point, shape (n, 3), lies below the nearest plane, negative above one, shape (n,) [m]."""
        if len(self.offsets) <= MOST_ASKED:
            chunks = [self.below(chunk).min(axis=1) for chunk in _chunks(points, CHUNK)]
        else:
            chunks = [self._nearest(chunk, 0.0)[0] for chunk in _chunks(points, FEW)]
        return np.concatenate(chunks) if chunks else np.zeros(0)

    def nearest(self, points: Floats, tie: float) -> Indices:
        """The first of the planes below which each point lies by at most `tie` [m] more than the least, shape (n,)."""
        if len(self.offsets) <= MOST_ASKED:
            chunks = [_first(self.below(chunk), tie) for chunk in _chunks(points, CHUNK)]
        else:
            chunks = [self._nearest(chunk, tie)[1] for chunk in _chunks(points, FEW)]
        return np.concatenate(chunks) if chunks else np.zeros(0, dtype=int)

    def below(self, points: Floats) -> Floats:
        """How far each point lies below each plane, shape (n, planes) [m]."""
        return self.offsets - points @ self.outward_normals.T

    def _nearest(self, points: Floats, tie: float) -> tuple[Floats, Indices]:
        """Depth below the nearest plane, and the first of those that are as near but for the tie."""
        along, least = points @ self._axes, np.full(len(points), np.inf)
        point, block = np.arange(len(points)), np.zeros(len(points), dtype=int)
        for level in self._levels:
            point, block = np.repeat(point, PIECES), (PIECES * block[:, None] + np.arange(PIECES)).ravel()
            plane = level.planes[block]
            below = self.offsets[plane] - np.einsum("bd,bd->b", self.outward_normals[plane], points[point])
            np.minimum.at(least, point, below)
            away = np.abs(along[point] - level.near[block])
            bounds = below - level.lags[block] - np.einsum("bd,bd->b", level.spreads[block], away)
            kept = np.flatnonzero(bounds <= least[point] + tie)
            point, block, plane, below = point[kept], block[kept], plane[kept], below[kept]
        near, first = below <= least[point] + tie, np.full(len(points), len(self.offsets))
        np.minimum.at(first, point[near], plane[near])
        return least, first

    @cached_property
    def _levels(self) -> "list[_Level]":
        """Blocks of a few pieces of all planes, pieces of those, and so on down to single planes."""
        size = np.ptp(self.middles, axis=0).max()
        pool = np.hstack([self.outward_normals, self.middles / size])
        depth = math.ceil(math.log(len(self.offsets), PIECES))
        order = halved(pool, depth * HALVINGS).ravel()
        return [self._level(order.reshape(PIECES**cuts, -1), ROUNDING * size) for cuts in range(1, depth + 1)]

    def _level(self, planes: Indices, rounding: float) -> "_Level":
        """Bounds of blocks, shape (blocks, planes of a block)."""
        normals, blocks = self.outward_normals[planes], np.arange(len(planes))
        central = norm(normals - normals.mean(axis=1, keepdims=True)).argmin(axis=1)
        chosen = planes[blocks, central]
        turns, near = normals - self.outward_normals[chosen, None], self.middles[chosen]
        rises = self.offsets[planes] - self.offsets[chosen, None] - np.einsum("bpd,bd->bp", turns, near)
        return _Level(
            planes=chosen,
            near=near @ self._axes,
            lags=rounding - rises.min(axis=1),
            spreads=np.abs(turns @ self._axes).max(axis=1),
        )

    @cached_property
    def _axes(self) -> Floats:
        """Principal axes of the facets' middles, as columns, shape (3, 3)."""
        axes: Floats = np.linalg.eigh(np.cov(self.middles.T))[1]
        return axes


@dataclass(frozen=True, eq=False, kw_only=True)
class _Level:
    """Planes in blocks of neighbours, with what bounds them: j, q, e, r of the module's docstring."""

    planes: Indices
    """j, shape (blocks,)."""

    near: Floats
    """q along the principal axes, shape (blocks, 3) [m]."""

    lags: Floats
    """e, a little more for rounding, shape (blocks,) [m]."""

    spreads: Floats
    """r along the principal axes, shape (blocks, 3)."""


def _first(below: Floats, tie: float) -> Indices:
    return (below <= below.min(axis=1, keepdims=True) + tie).argmax(axis=1)


def _chunks(points: Floats, size: int) -> list[Floats]:
    return [points[start : start + size] for start in range(0, len(points), size)]
