"""A hollow cup, as one mesh and as overlapping boxes, for tests."""

from pathlib import Path

import numpy as np
import trimesh

from tests.strategies.mjcf_files import world, written

HALF, WALL = 0.04, 0.008
"""Half of every outer edge, and the thickness of walls and bottom [m]."""


def cup_mesh() -> trimesh.Trimesh:
    """A closed mesh about the origin, open at the top."""
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    rings = [
        np.column_stack([signs * half, np.full(4, height)])
        for half, height in ((HALF, -HALF), (HALF, HALF), (HALF - WALL, HALF), (HALF - WALL, WALL - HALF))
    ]
    faces = [(0, 2, 1), (0, 3, 2), (12, 13, 14), (12, 14, 15)]
    for ring in range(3):
        for side in range(4):
            a, b = 4 * ring + side, 4 * ring + (side + 1) % 4
            faces += [(a, b, b + 4), (a, b + 4, a + 4)]
    return trimesh.Trimesh(np.concatenate(rings), faces, process=False)


def mesh_cup(folder: Path, name: str = "cup.xml") -> Path:
    """The cup as one mesh geom, which MuJoCo fills."""
    cup_mesh().export(folder / "cup.stl")
    geom = '<geom name="shell" type="mesh" mesh="cup" friction=".4"/>'
    text = world(f'<body name="cup" pos="1 2 3">{geom}</body>', '<mesh name="cup" file="cup.stl"/>')
    return written(folder, text, name)


def box_cup(folder: Path) -> Path:
    """The cup as a bottom and four walls that overlap at the corners."""
    half, inset, height = WALL / 2, HALF - WALL / 2, f"{HALF} {WALL / 2} {HALF}"
    across = f"{WALL / 2} {HALF} {HALF}"
    walls = (
        (f"{HALF} {HALF} {half}", f"0 0 {-inset}"),
        (across, f"{inset} 0 0"),
        (across, f"{-inset} 0 0"),
        (height, f"0 {inset} 0"),
        (height, f"0 {-inset} 0"),
    )
    geoms = "".join(f'<geom type="box" size="{size}" pos="{place}"/>' for size, place in walls)
    return written(folder, world(f'<body name="cup">{geoms}</body>'), "boxes.xml")
