"""Wrenches of W_R = conv { w_1, ..., w_l } other than its vertices: inside, on the boundary, and on closed paths."""

from itertools import combinations

import numpy as np

from planner.arrays import Floats

WAYPOINTS = 24
"""Corners of the polygon that a rotating load follows."""
INSIDE = 1 - 1e-9
"""Keeps round-off from leaving W_R."""


def interior_wrenches(vertices: Floats, count: int, rng: np.random.Generator) -> Floats:
    """Random convex combinations of the vertices, shape (count, D)."""
    return rng.dirichlet(np.ones(len(vertices)), size=count) @ vertices


def boundary_wrenches(vertices: Floats, count: int, rng: np.random.Generator) -> Floats:
    """Where random rays from the middle leave W_R, within the space that it spans, shape (count, D)."""
    center = vertices.mean(axis=0)
    directions = rng.normal(size=(count, len(vertices))) @ (vertices - center)
    return np.array([center + INSIDE * reach(vertices, center, along) * along for along in directions])


def rotating_forces(vertices: Floats) -> Floats:
    """Gravity as a turning object feels it: forces of constant size that turn about each axis, as large as W_R allows.

    Args:
        vertices: Shape (l, 6) [N, N m].

    Returns:
        Closed paths from corner to corner, shape (paths, WAYPOINTS + 1, 6); a plane in which W_R holds no circle
        about its middle has no path. The polygon between the corners is in W_R too, which is convex.
    """
    axes = np.eye(3, 6) * np.abs(vertices[:, :3]).max()
    return _loops(vertices, [(axes[first], axes[second]) for first, second in combinations(range(3), 2)])


def rotating_wrenches(vertices: Floats, count: int, rng: np.random.Generator) -> Floats:
    """The same in random planes of the space that W_R spans, shape (at most count, WAYPOINTS + 1, D)."""
    spread = vertices - vertices.mean(axis=0)
    return _loops(vertices, [tuple(rng.normal(size=(2, len(vertices))) @ spread) for _ in range(count)])


def reach(vertices: Floats, origin: Floats, direction: Floats) -> float:
    """The largest s with origin + s direction in W_R: a linear program in the weights of the vertices.

    Returns:
        Zero if no such s is positive.
    """
    from scipy.optimize import linprog  # here: only validations beyond the vertices need it

    scale = np.abs(vertices).max(axis=0)
    scale[scale == 0] = 1.0
    balance = np.vstack([np.hstack([(vertices / scale).T, -(direction / scale)[:, None]]), np.ones(len(vertices) + 1)])
    balance[-1, -1] = 0.0
    cost = np.append(np.zeros(len(vertices)), -1.0)
    answer = linprog(cost, A_eq=balance, b_eq=np.append(origin / scale, 1.0), method="highs")
    return float(answer.x[-1]) if answer.success else 0.0


def _loops(vertices: Floats, planes: list[tuple[Floats, ...]]) -> Floats:
    center = vertices.mean(axis=0)
    angles = 2 * np.pi * np.arange(WAYPOINTS + 1) / WAYPOINTS
    loops = []
    for first, second in planes:
        circle = np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second
        radius = INSIDE * min(reach(vertices, center, along) for along in circle[:-1])
        if radius > 0:
            loops.append(center + radius * circle)
    return np.array(loops).reshape(len(loops), len(angles), vertices.shape[1])
