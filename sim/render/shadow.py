"""The soft shadow of the object on the floor: its triangles from above, slightly slanted, and blurred."""

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from planner.arrays import Floats, Pixels
from sim.render.palette import BACKGROUND, rgb

SLANT = np.array([0.12, -0.06])
"""How far the shadow moves aside per height above the floor."""
BLUR = 0.022
"""Of its edge, relative to the floor's width."""
DARKNESS = 0.30
"""Of its middle."""
TINT = "#3b4a5e"
"""Its colour where it would be black."""


def fallen(points: Floats, floor: float) -> Floats:
    """Where the shadows of points, shape (..., 3), fall on the floor, shape (..., 2) [m]."""
    return points[..., :2] + SLANT * (points[..., 2:] - floor)


def soft_shadow(triangles: Floats, floor: float, half: float, pixels: int) -> Pixels:
    """The floor's texture.

    Args:
        triangles: Of the object where it is now, shape (triangles, 3, 3) [m].
        floor: Height of the floor [m].
        half: Half the floor's width [m].
        pixels: Width of the texture.

    Returns:
        Red, green and blue from 0 to 255, shape (pixels, pixels, 3); rows along y, columns along x.
    """
    corners = (fallen(triangles, floor) / half + 1) * pixels / 2
    mask = Image.new("L", (pixels, pixels))
    draw = ImageDraw.Draw(mask)
    for triangle in corners:
        draw.polygon([(x, y) for x, y in triangle], fill=255, outline=255)
    share = np.asarray(mask.filter(ImageFilter.GaussianBlur(BLUR * pixels)), dtype=float)[..., None] / 255
    return (np.array(rgb(BACKGROUND)) * (1 - DARKNESS * share) + np.array(rgb(TINT)) * DARKNESS * share * 0.35).astype(
        np.uint8
    )
