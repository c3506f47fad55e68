"""Asks MuJoCo where the object's surface is: a small ball put above it, measured against the original model.

A ball of radius r whose centre is lifted by r + h off a point of a convex part, along the outward normal there, is h
away from that part, and the shortest line to it is the normal. Frame: body frame B, SI.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from planner.objects.compiled import CompiledObject, compile_object
from planner.objects.rigid_object import RigidObject
from planner.objects.vectors import norm

RADIUS, HEIGHT = 2e-3, 1e-3
"""r and h, relative to the object's size."""

CONVERGED = 1e-10
"""Tolerance of MuJoCo's convex collision detection [m]; its default of 1e-6 would be what we measure."""

PROBE = "rhograsp/probe"
"""Name of the ball and its body."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CollisionMeasurement:
    """What MuJoCo says of surface points."""

    heights: np.ndarray
    """How far each point lies above the surface of its part, negative inside, shape (n,) [m]."""

    turns: np.ndarray
    """Angle between each point's normal and MuJoCo's, shape (n,) [rad]."""

    free: np.ndarray
    """Whether the ball above the point touches no other part, shape (n,)."""


def measure_collision(
    rigid_object: RigidObject, points: np.ndarray, normals: np.ndarray, part: np.ndarray
) -> CollisionMeasurement:
    """Compare points of the object's surface with the model its file compiles to.

    Args:
        rigid_object: The object.
        points: Shape (n, 3) [m].
        normals: Inward unit normals, shape (n, 3).
        part: Part of each point, shape (n,).

    Raises:
        ObjectError: If the file cannot be compiled any more.
    """
    radius, height = RADIUS * rigid_object.size, HEIGHT * rigid_object.size
    ball = _Ball(rigid_object, radius)
    centers = points - (radius + height) * normals
    gaps, directions = np.empty(len(points)), np.empty((len(points), 3))
    for index, (center, own) in enumerate(zip(centers, part, strict=True)):
        gaps[index], directions[index] = ball.shortest_line(center, own)
    free = np.ones(len(points), dtype=bool)
    for other, each in enumerate(rigid_object.parts):
        lower, upper = each.bounds()
        near = ((centers > lower - radius) & (centers < upper + radius)).all(axis=1)
        for close in np.flatnonzero(near & free & (part != other)):
            free[close] = ball.shortest_line(centers[close], other)[0] > 0
    sines, cosines = norm(np.cross(directions, normals)), (directions * normals).sum(axis=1)
    return CollisionMeasurement(heights=gaps - height, turns=np.arctan2(sines, cosines), free=free)


class _Ball:
    """The object's own model with one ball that is put where it is wanted."""

    def __init__(self, rigid_object: RigidObject, radius: float) -> None:
        def add_ball(spec: mujoco.MjSpec) -> None:
            body = spec.worldbody.add_body(name=PROBE)
            body.add_geom(name=PROBE, type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0, 0], contype=0, conaffinity=0)
            spec.option.ccd_tolerance = CONVERGED

        self._compiled: CompiledObject = compile_object(rigid_object.source, add_ball)
        self._model = self._compiled.model
        self._data = mujoco.MjData(self._model)
        self._data.qpos[:] = self._compiled.configuration
        mujoco.mj_kinematics(self._model, self._data)
        root = next(iter(self._compiled.poses))
        self._rotation = self._data.xmat[root].reshape(3, 3).copy()
        self._origin = self._data.xpos[root].copy()
        self._geom = self._model.geom(PROBE).id
        self._far = 10 * rigid_object.size

    def shortest_line(self, center: np.ndarray, part: int) -> tuple[float, np.ndarray]:
        """Distance of the ball's surface from a part [m], and the direction to it, shape (3,); zero if they touch."""
        self._data.geom_xpos[self._geom] = self._origin + self._rotation @ center
        ends = np.zeros(6)
        geom = self._compiled.colliding[part]
        distance = mujoco.mj_geomDistance(self._model, self._data, self._geom, geom, self._far, ends)
        line = self._rotation.T @ (ends[3:] - ends[:3])
        length = float(norm(line))
        return distance, line / length if length > 0 else line
