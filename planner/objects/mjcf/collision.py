"""Asks MuJoCo where the object's surface is: a small ball put on it, measured against the original model.

Frame: body frame B, SI.
"""

import mujoco
import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.objects.mjcf.compiled import compile_object
from planner.objects.mjcf.touch import TIP, Touch, TouchProbe
from planner.objects.rigid_object import RigidObject

PROBE = "rhograsp/probe"
"""Name of the ball and its body."""

MARGIN = 0.1
"""Share by which the planner is stricter than the simulator; single precision needs less."""


def measure_collision(rigid_object: RigidObject, points: Floats, normals: Floats, part: Indices) -> Touch:
    """Compare points of the object's surface with the model its file compiles to.

    Args:
        rigid_object: The object.
        points: Shape (n, 3) [m].
        normals: Inward unit normals, shape (n, 3).
        part: Part of each point, shape (n,).

    Returns:
        What balls of radius TIP of the object's size touch there; parts out of their reach count as far.

    Raises:
        ObjectError: If the file cannot be compiled any more.
    """
    radius = TIP * rigid_object.size
    compiled = compile_object(rigid_object.source, _add_ball)
    model, geoms, pose = compiled.model, np.array(compiled.colliding), compiled.pose_in_file
    ball = model.geom(PROBE).id
    probe = TouchProbe(model, ball, geoms, rigid_object.size, MARGIN, compiled.configuration)
    asked = _in_reach(rigid_object, points - radius * normals, 2 * radius)
    asked[np.arange(len(points)), part] = True
    return probe.touch(pose.to_body(points), pose.rotate(normals), radius, asked)


def _in_reach(rigid_object: RigidObject, centers: Floats, reach: float) -> Mask:
    """Which parts' bounding boxes are within reach of each ball's centre, shape (balls, parts)."""
    bounds = np.array([part.bounds() for part in rigid_object.parts])
    boxes = zip(bounds[:, 0] - reach, bounds[:, 1] + reach, strict=True)
    return np.stack([((centers > lower) & (centers < upper)).all(axis=1) for lower, upper in boxes], axis=1)


def _add_ball(spec: mujoco.MjSpec) -> None:
    body = spec.worldbody.add_body(name=PROBE)
    body.add_geom(name=PROBE, type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[1, 0, 0], contype=0, conaffinity=0)
