"""Two hard fingers in space cannot resist a moment about the line through them.

For contacts at arms r_1, r_2 and the unit vector u of their line, the direction lambda = (r_1 x u, u) gives
G_1' lambda = G_2' lambda = 0: no contact force, in or out of the friction cones, works along it. It is a cut that
needs no solver, one per pair, and it settles almost every pair for almost every W_R.
"""

from collections.abc import Iterator

import numpy as np

from planner.contacts import grasp_maps
from planner.friction_cone import support
from planner.search.problem import SearchProblem


def pairs(problem: SearchProblem) -> Iterator[np.ndarray]:
    """All pairs that keep kinds, spacing and span, by their first member; arrays of shape (pairs, 2)."""
    alike = len(problem.all_kinds) == 1
    for first in range(len(problem.contacts) - 1):
        partner = problem.partners(np.array([first])) & (alike | (problem.kind != problem.kind[first]))
        second = first + 1 + np.flatnonzero(partner[first + 1 :])
        yield np.stack([np.full_like(second, first), second], axis=1)


def line_bounds(problem: SearchProblem, subsets: np.ndarray) -> np.ndarray:
    """Upper bounds on 1 / rho of pairs, from the moment about their line.

    Args:
        problem: With two fingers in space.
        subsets: Candidate indices, shape (pairs, 2).

    Returns:
        Shape (pairs,) [1/N]; infinite where W_R asks for no moment about the line.
    """
    contacts = problem.contacts
    arms = (contacts.points - problem.reference_point)[subsets]
    line = arms[:, 1] - arms[:, 0]
    length = np.linalg.norm(line, axis=1, keepdims=True)
    line = np.where(length > 0, line / np.where(length > 0, length, 1), [1.0, 0.0, 0.0])
    directions = np.hstack([np.cross(arms[:, 0], line), line])
    work = directions @ problem.wrenches.T
    flip = np.where(work.max(axis=1) > -work.min(axis=1), -1.0, 1.0)
    directions *= flip[:, None]
    loads = np.abs(work).max(axis=1)
    maps = grasp_maps(contacts.points, problem.reference_point)[subsets]
    pulls = np.einsum("piDd,pD->pid", maps, directions)
    capacity = support(pulls, contacts.normals[subsets], contacts.friction[subsets])
    capacity = (problem.strengths[subsets] * capacity).sum(axis=1)
    bounds = np.full(len(subsets), np.inf)
    np.divide(capacity, loads, out=bounds, where=loads > 0)
    return bounds
