"""What a small ball touches that rests on an object's surface: one question, asked by the planner and by the simulator.

A ball of radius r that rests at p, inward normal n, has its centre at c = p - r n. With q the point of a convex part
nearest to c, the part's gap to the ball is |q - c| - r, its turn the angle between q - c and n, and its rise
r - (q - c) . n, the height of q above the tangent plane at p.

A part that is near but does not rise above the tangent plane, neither there nor a little aside, is flush: it goes on
with the surface under the ball, as coincident geoms and coplanar faces do, and the ball has one contact with the union.
Any other part that is near is a wall: the ball rests on two surfaces at once, which no planned contact means.
"""

from copy import copy
from dataclasses import dataclass

import mujoco
import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.contacts import contact_frames
from planner.objects.vectors import norm

TIP = 1e-3
"""Radius of the smallest ball that must rest where a contact is planned, relative to the object's size."""

CLEARANCE = 2e-4
"""Parts with a smaller gap are near, relative to the object's size: a finger under load may touch them."""

ON_SURFACE = 1e-6
"""Largest |gap| of the part that is touched, and largest rise of a flush part, relative to the object's size."""

SAME_NORMAL = np.deg2rad(0.1)
"""Largest turn of the part that is touched [rad]."""

CONVERGED = 1e-10
"""Tolerance of MuJoCo's convex collision detection [m]; its default of 1e-6 would be what we measure."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Touch:
    """Where the parts of an object are for balls that rest on it; parts not asked for are infinitely far."""

    gaps: Floats
    """Signed distance of each ball from each part, shape (balls, parts) [m]."""

    turns: Floats
    """Angle between the way from each centre to each part and the inward normal, shape (balls, parts) [rad]."""

    rises: Floats
    """Height of each part's nearest point above the tangent plane, shape (balls, parts) [m]."""

    aside: Floats
    """Least signed distance of each ball from each part if it slides by the clearance along the tangent plane, shape
    (balls, parts) [m]; infinite where no near part of another normal goes on below that plane."""

    size: float
    """Of the object [m]."""

    margin: float = 0.0
    """Share by which every threshold is stricter: MuJoCo rounds a mesh anew, to single precision, in every model."""

    @property
    def near(self) -> Mask:
        """Whether each ball touches each part, or may touch it under load, shape (balls, parts)."""
        return self.gaps < CLEARANCE * self.size * (1 + self.margin)

    @property
    def flush(self) -> Mask:
        """Whether each part goes on with the surface under each ball, shape (balls, parts)."""
        return self.near & (self.rises <= self._even) & (self.aside >= -self._even)

    @property
    def walls(self) -> Mask:
        """Whether each part is another surface that each ball touches too, shape (balls, parts)."""
        return self.near & ~self.flush

    @property
    def on_surface(self) -> Mask:
        """Whether each ball touches each part, neither above nor inside, shape (balls, parts)."""
        return np.abs(self.gaps) <= self._even

    @property
    def aligned(self) -> Mask:
        """Whether each part has the expected normal, shape (balls, parts)."""
        return self.turns <= SAME_NORMAL * (1 - self.margin)

    @property
    def _even(self) -> float:
        return ON_SURFACE * self.size * (1 - self.margin)


class TouchProbe:
    """A ball of a compiled model, put where it is wanted beside geoms that stay where they are.

    The ball is measured with half its radius about the same centre, so that one that rests a little too deep has a
    nearest point too.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        ball: int,
        geoms: Indices,
        size: float,
        margin: float = 0.0,
        configuration: Floats | None = None,
    ) -> None:
        """Copy the model.

        Args:
            model: Holds the ball and the object.
            ball: Geom id of a sphere.
            geoms: Geom ids of the object's parts, shape (parts,).
            size: Of the object [m].
            margin: See `Touch.margin`.
            configuration: Coordinates qpos of the joints, shape (nq,); by default qpos0.
        """
        self._model, self._ball, self._geoms = copy(model), ball, geoms
        self._model.opt.ccd_tolerance = CONVERGED
        self._data = mujoco.MjData(self._model)
        if configuration is not None:
            self._data.qpos[:] = configuration
        mujoco.mj_kinematics(self._model, self._data)
        self.size, self._margin, self._far = size, margin, 10 * size

    def touch(self, points: Floats, normals: Floats, radius: float, asked: Mask | None = None) -> Touch:
        """Rest balls on the surface.

        Args:
            points: Where, in the world, shape (balls, 3) [m].
            normals: Inward unit normals, shape (balls, 3).
            radius: Of the balls [m].
            asked: Which parts matter to each ball, shape (balls, parts); all by default.
        """
        asked = np.ones((len(points), len(self._geoms)), dtype=bool) if asked is None else asked
        distances, nearest = self._nearest(points - radius * normals, radius, asked)
        outside = (distances > 0) & (distances < self._far)
        ways = np.where(outside[..., None], nearest, 0.0) - (points - radius * normals)[:, None]
        along = (ways * normals[:, None]).sum(axis=2)
        across = norm(np.cross(ways, normals[:, None]))
        turns, gaps = np.where(outside, np.arctan2(across, along), np.pi), distances - radius / 2
        leaning = (gaps < 2 * CLEARANCE * self.size) & (turns > SAME_NORMAL / 2)
        return Touch(
            gaps=gaps,
            turns=turns,
            rises=np.where(outside, radius - along, np.inf),
            aside=self._aside(points, normals, radius, leaning),
            size=self.size,
            margin=self._margin,
        )

    def _aside(self, points: Floats, normals: Floats, radius: float, asked: Mask) -> Floats:
        """See `Touch.aside`, for the parts asked for."""
        rows = np.flatnonzero(asked.any(axis=1))
        least = np.full(asked.shape, np.inf)
        for step in all_round(normals[rows], CLEARANCE * self.size):
            distances, _ = self._nearest(points[rows] + step - radius * normals[rows], radius, asked[rows])
            least[rows] = np.minimum(least[rows], distances - radius / 2)
        return least

    def _nearest(self, centers: Floats, radius: float, asked: Mask) -> tuple[Floats, Floats]:
        """Distance from each ball of half the radius to each part asked for, and that part's nearest point."""
        self._model.geom_size[self._ball, 0] = radius / 2
        distances, nearest, ends = np.full(asked.shape, np.inf), np.full((*asked.shape, 3), np.inf), np.zeros(6)
        for ball, part in np.argwhere(asked):
            self._data.geom_xpos[self._ball] = centers[ball]
            distances[ball, part] = mujoco.mj_geomDistance(
                self._model, self._data, self._ball, self._geoms[part], self._far, ends
            )
            nearest[ball, part] = ends[3:]
        return distances, nearest


def all_round(normals: Floats, length: float) -> Floats:
    """Steps along the tangent planes in eight directions, shape (8, normals, 3) [m]."""
    first, second = (length * contact_frames(normals)[:, :, 1:]).transpose(2, 0, 1)
    angles = np.arange(8) * np.pi / 4
    return np.cos(angles)[:, None, None] * first + np.sin(angles)[:, None, None] * second
