"""The planes of a convex polyhedron's facets: how deep a point lies below the nearest, of few facets or of 200,000.

A point p lies o_k - n_k . p below plane k. Few planes are all asked. Many are bounded in blocks of neighbours: with a
point q of the polyhedron near a block, m the mean normal, r the largest |n_k - m| and e the least depth of q below the
block's planes,

    o_k - n_k . p  =  (o_k - n_k . q) - n_k . (p - q)  >=  e - m . (p - q) - r |p - q|,

so that only blocks are asked whose bound is below the least depth already found.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial.distance import cdist

from planner.arrays import Floats, Indices
from planner.objects.neighbour_blocks import neighbour_blocks
from planner.objects.vectors import norm

MOST_ASKED = 4096
"""Of more planes than these most are not asked."""

CHUNK = 4096
"""Points compared with few planes at once: bounds the memory."""

FEW = 256
"""The same for many planes, with some blocks of which each point is compared."""

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
        bounds = self._blocks.bounds(points)
        everyone = np.arange(len(points))
        least = self._asked(points, everyone, bounds.argmin(axis=1)).min(axis=1)
        point, block = np.nonzero(bounds <= least[:, None] + tie)
        depths, first = np.full(len(points), np.inf), np.full(len(points), len(self.offsets))
        pieces = [slice(start, start + CHUNK) for start in range(0, len(point), CHUNK)]
        for some in pieces:
            np.minimum.at(depths, point[some], self._asked(points, point[some], block[some]).min(axis=1))
        for some in pieces if tie else []:
            near = self._asked(points, point[some], block[some]) <= depths[point[some], None] + tie
            planes = np.where(near, self._blocks.planes[block[some]], len(self.offsets))
            np.minimum.at(first, point[some], planes.min(axis=1))
        return depths, first

    def _asked(self, points: Floats, point: Indices, block: Indices) -> Floats:
        """How far some points lie below the planes of one block each, shape (asked, planes of a block) [m]."""
        planes = self._blocks.planes[block]
        return self.offsets[planes] - np.einsum("apd,ad->ap", self.outward_normals[planes], points[point])

    @cached_property
    def _blocks(self) -> "_Blocks":
        size = np.ptp(self.middles, axis=0).max()
        planes = neighbour_blocks(np.hstack([self.outward_normals, self.middles / size]))
        normals, near = self.outward_normals[planes].mean(axis=1), self.middles[planes].mean(axis=1)
        below = self.offsets[planes] - np.einsum("bpd,bd->bp", self.outward_normals[planes], near)
        return _Blocks(
            planes=planes,
            normals=normals,
            near=near,
            spreads=norm(self.outward_normals[planes] - normals[:, None]).max(axis=1),
            depths=below.min(axis=1) - ROUNDING * size,
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class _Blocks:
    """Planes in blocks of neighbours, with what bounds them: e, m, r, q of the module's docstring."""

    planes: Indices
    """Their numbers, shape (blocks, planes of a block)."""

    normals: Floats
    """m, shape (blocks, 3)."""

    spreads: Floats
    """r, shape (blocks,)."""

    near: Floats
    """q, shape (blocks, 3) [m]."""

    depths: Floats
    """e, a little less for rounding, shape (blocks,) [m]."""

    def bounds(self, points: Floats) -> Floats:
        """Depths below which no point, shape (n, 3), lies under a plane of each block, shape (n, blocks) [m]."""
        along = self.depths + (self.normals * self.near).sum(axis=1) - points @ self.normals.T
        return along - self.spreads * cdist(points, self.near)


def _first(below: Floats, tie: float) -> Indices:
    return (below <= below.min(axis=1, keepdims=True) + tie).argmax(axis=1)


def _chunks(points: Floats, size: int) -> list[Floats]:
    return [points[start : start + size] for start in range(0, len(points), size)]
