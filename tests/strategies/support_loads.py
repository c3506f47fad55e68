"""Grasps under loads that they only need to support: a bar in a V block, a ball, a nose cone, a block on a table."""

import numpy as np

from planner.contacts import Contacts
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.sphere import Sphere
from planner.objects.pose import Pose
from tests.strategies.parts import box
from tests.strategies.planned_grasps import Planned

WEIGHT = 9.81
ORIGIN = np.zeros(3)


def bar_in_v_block(friction: float) -> Planned:
    """A square bar rests with two faces on four fingers, gravity along the diagonal of its section."""
    points = np.array([(-0.02, 0.04, 0), (-0.02, -0.04, 0), (0, 0.04, -0.02), (0, -0.04, -0.02)])
    normals = np.array([(1.0, 0, 0), (1, 0, 0), (0, 0, 1), (0, 0, 1)])
    contacts = Contacts(points=points, normals=normals, friction=np.full(4, friction))
    down = WEIGHT * np.array([[-np.sqrt(0.5), 0, -np.sqrt(0.5), 0, 0, 0]])
    return Planned(parts=(box((0.02, 0.06, 0.02)),), contacts=contacts, reference_point=ORIGIN, wrenches=down)


def ball_on_fingers(friction: float, tilt: float, sideways: float = 0.0) -> Planned:
    """A ball on three fingers below it, `tilt` off the pole: a nose without the cone."""
    around = np.deg2rad([0.0, 120.0, 240.0])
    polar = np.deg2rad(tilt)
    outward = np.stack(
        [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.full(3, -np.cos(polar))], axis=1
    )
    ball = Sphere(pose=Pose.identity(), radius=0.03, geom="ball", friction=friction)
    contacts = Contacts(points=0.03 * outward, normals=-outward, friction=np.full(3, friction))
    down = np.array([[0, 0, -WEIGHT, 0, 0, 0], [sideways * WEIGHT, 0, -WEIGHT, 0, 0, 0]])
    return Planned(parts=(ball,), contacts=contacts, reference_point=ORIGIN, wrenches=down)


def nose_cone(sides: int, half_angle: float, friction: float) -> Planned:
    """A polyhedral cone, point down, on three fingers below its faces, `half_angle` off its axis."""
    slope, around = np.deg2rad(half_angle), np.deg2rad([0.0, 120.0, 240.0])
    rim = 2 * np.pi * (np.arange(sides) + 0.5) / sides
    height, radius = 0.04, 0.04 * np.tan(slope)
    corners = np.stack([radius * np.cos(rim), radius * np.sin(rim), np.full(sides, height)], axis=1)
    part = Polyhedron.hull(np.vstack([corners, np.zeros(3)]), geom="nose", friction=friction)
    apothem = np.arctan(np.tan(slope) * np.cos(np.pi / sides))  # of a face, where the fingers are
    out = np.stack([np.cos(around), np.sin(around), np.zeros(3)], axis=1)
    down = np.array([0, 0, -1.0])
    points = 0.03 * (np.tan(apothem) * out - down)
    normals = -(np.cos(apothem) * out + np.sin(apothem) * down)
    contacts = Contacts(points=points, normals=normals, friction=np.full(3, friction))
    load = WEIGHT * np.array([[0, 0, -1, 0, 0, 0], [0.05, 0, -1, 0, 0, 0]])
    return Planned(parts=(part,), contacts=contacts, reference_point=np.array([0, 0, 0.03]), wrenches=load)


def block_on_table(sideways: float) -> Planned:
    """A flat block on three fingers, pushed sideways by this part of its weight."""
    points = np.array([(0.02, 0, -0.01), (-0.01, 0.015, -0.01), (-0.01, -0.015, -0.01)])
    contacts = Contacts(points=points, normals=np.tile([0.0, 0, 1], (3, 1)), friction=np.full(3, 0.4))
    push = WEIGHT * np.array([[sideways, 0, -1, 0, 0.01 * sideways, 0]])
    return Planned(parts=(box((0.03, 0.03, 0.01)),), contacts=contacts, reference_point=ORIGIN, wrenches=push)
