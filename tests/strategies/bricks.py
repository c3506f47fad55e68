"""An object without a surface, for tasks that need only its mass and its size."""

from pathlib import Path

import numpy as np

from planner.objects.object_source import ObjectSource
from planner.objects.rigid_object import RigidObject


def brick(mass: float = 0.5) -> RigidObject:
    """Mass and extent, which is all that most presets ask for."""
    return RigidObject(
        source=ObjectSource(file=Path("brick.xml")),
        sha256="",
        body="brick",
        parts=(),
        mass=mass,
        center_of_mass=np.array([0.01, 0.0, 0.02]),
        inertia=1e-4 * np.eye(3),
        extent=np.array([0.2, 0.05, 0.1]),
    )
