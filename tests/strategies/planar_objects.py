"""Planar objects made without a file, for tests."""

from pathlib import Path

import numpy as np

from planner.arrays import Floats
from planner.objects.planar.outline import Outline
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.planar.simple_polygon import simple_polygon

RECTANGLE = [(-0.03, -0.02), (0.03, -0.02), (0.03, 0.02), (-0.03, 0.02)]
"""60 x 40 mm about the origin."""

HOOK = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (3.0, 3.0), (3.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
"""A concave outline of two arms of different length, area 4 + 2 + 1."""


def planar_object(corners: list[tuple[float, float]], mass: float = 0.05, thickness: float = 0.01) -> PlanarObject:
    """An object with this outline and friction 0.7."""
    polygon = simple_polygon(np.array(corners, dtype=float), "made")
    return PlanarObject(
        file=Path("made.toml"),
        sha256="",
        body="made",
        outline=Outline(geom="made", friction=0.7, corners=polygon),
        mass=mass,
        thickness=thickness,
    )


def star(seed: int, corners: int = 12) -> Floats:
    """A random star-shaped polygon about the origin, mostly concave, shape (corners, 2)."""
    generator = np.random.default_rng(seed)
    angles = 2 * np.pi * (np.arange(corners) + generator.uniform(0.1, 0.9, corners)) / corners
    return generator.uniform(0.3, 1.0, corners)[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
