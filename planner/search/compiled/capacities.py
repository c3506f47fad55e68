"""What every candidate can do along one direction of wrench space."""

from math import hypot, sqrt

import numpy as np

from planner.search.compiled.compile import compiled


@compiled("(f8[:, :, ::1], f8[::1], f8[::1], f8[::1])")
def capacities(maps: np.ndarray, friction: np.ndarray, direction: np.ndarray, values: np.ndarray) -> None:
    """h_i(lambda) = |Proj_K(G_i' lambda)| of all candidates, see `planner.friction_cone.support`.

    Args:
        maps: Grasp maps from contact frames, the normal first, G_i R_i, shape (n, D, d).
        friction: Shape (n,).
        direction: lambda, shape (D,).
        values: h_i, set in place, shape (n,).
    """
    count, size, dimension = maps.shape
    for i in range(count):
        along = square = 0.0
        for axis in range(dimension):
            pull = 0.0
            for row in range(size):
                pull += maps[i, row, axis] * direction[row]
            if axis == 0:
                along = pull
            else:
                square += pull * pull
        across = sqrt(square)
        if across <= friction[i] * along:
            values[i] = hypot(along, across)
        else:
            values[i] = max(0.0, (along + friction[i] * across) / sqrt(1 + friction[i] * friction[i]))
