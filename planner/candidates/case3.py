"""The 217 candidates of the paper's Case III, a right isosceles triangular prism.

Legs 4, height 2, the origin at the centroid, the right-angled corner at x = y = -4/3, the hypotenuse on
x + y = 4/3. The paper has no unit; one of its units is a centimetre here. It leaves the heights of the layers open
and does not print the height of the prism, which both printed values of rho determine.
Source: Watanabe and Yoshikawa, section 4.
"""

import numpy as np

from planner.arrays import Floats

UNIT = 0.01
"""One unit of the paper [m]."""

CORNER, LEG, HALF_HEIGHT = -4 / 3, 4.0, 1.0
LAYERS = np.array([-0.8, -0.4, 0.0, 0.4, 0.8])
"""Middles of five equal cells over the height."""

LEG_CELLS, HYPOTENUSE_CELLS = 9, 11


def case3_points() -> Floats:
    """Faces at x = -4/3, y = -4/3 (9 x 5 each), the hypotenuse (11 x 5), bottom and top (36 each).

    Returns:
        Shape (217, 3) [m].
    """
    along_leg = CORNER + (np.arange(LEG_CELLS) + 0.5) * LEG / LEG_CELLS
    along_hypotenuse = CORNER + (np.arange(HYPOTENUSE_CELLS) + 0.5) * LEG / HYPOTENUSE_CELLS
    first, second = np.meshgrid(np.arange(LEG_CELLS), np.arange(LEG_CELLS), indexing="ij")
    inside = first + second < LEG_CELLS - 1
    base = np.column_stack([along_leg[first[inside]], along_leg[second[inside]]])
    walls = [
        np.column_stack([np.full(LEG_CELLS, CORNER), along_leg]),
        np.column_stack([along_leg, np.full(LEG_CELLS, CORNER)]),
        np.column_stack([along_hypotenuse, along_hypotenuse[::-1]]),
    ]
    layers = [_at_height(wall, z) for wall in walls for z in LAYERS]
    caps = [_at_height(base, z) for z in (-HALF_HEIGHT, HALF_HEIGHT)]
    return UNIT * np.concatenate(layers + caps)


def _at_height(plane_points: Floats, z: float) -> Floats:
    return np.column_stack([plane_points, np.full(len(plane_points), z)])
