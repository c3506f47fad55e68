"""Small convex parts and objects made without MuJoCo, for tests."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from planner.objects.object_source import ObjectSource
from planner.objects.parts.box import Box
from planner.objects.parts.capsule import Capsule
from planner.objects.parts.cylinder import Cylinder
from planner.objects.parts.ellipsoid import Ellipsoid
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.sphere import Sphere
from planner.objects.pose import Pose
from planner.objects.rigid_object import ConvexPart, RigidObject

TILTED = Pose(position=np.array([0.3, -0.2, 0.1]), quaternion=np.array([0.5, -0.1, 0.7, 0.5]))
NAME, FRICTION = "part", 0.7

PRISM_CORNERS = np.array([(x, y, z) for z in (-1, 1) for x, y in [(-4 / 3, -4 / 3), (8 / 3, -4 / 3), (-4 / 3, 8 / 3)]])
"""The paper's Case III, in its own unit."""


def tilted_parts() -> dict[str, ConvexPart]:
    """One part of every shape, rotated and shifted."""
    return {
        "polyhedron": Polyhedron.hull(TILTED.to_body(0.05 * PRISM_CORNERS), geom=NAME, friction=FRICTION),
        "box": Box.placed(TILTED, np.array([0.1, 0.2, 0.05]), geom=NAME, friction=FRICTION),
        "sphere": Sphere(pose=TILTED, radius=0.2, geom=NAME, friction=FRICTION),
        "ellipsoid": Ellipsoid(pose=TILTED, semi_axes=np.array([0.3, 0.1, 0.05]), geom=NAME, friction=FRICTION),
        "cylinder": Cylinder(pose=TILTED, radius=0.1, half_length=0.2, geom=NAME, friction=FRICTION),
        "capsule": Capsule(pose=TILTED, radius=0.1, half_length=0.2, geom=NAME, friction=FRICTION),
    }


def box(half_lengths: tuple[float, float, float], center: tuple[float, float, float] = (0, 0, 0)) -> Box:
    """A box along the axes of B."""
    pose = replace(Pose.identity(), position=np.array(center, dtype=float))
    return Box.placed(pose, np.array(half_lengths, dtype=float), geom=NAME, friction=FRICTION)


def rigid_object(*parts: ConvexPart) -> RigidObject:
    """An object of these parts; its mass properties mean nothing."""
    corners = np.concatenate([part.bounds() for part in parts])
    return RigidObject(
        source=ObjectSource(file=Path("made.xml")),
        sha256="0" * 64,
        body="made",
        parts=parts,
        mass=1.0,
        center_of_mass=np.zeros(3),
        inertia=np.eye(3),
        extent=np.ptp(corners, axis=0),
    )
