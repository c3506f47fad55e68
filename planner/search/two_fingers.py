"""Two hard fingers in space cannot resist a moment about the line through them, and others only by torsional friction.

For contacts at arms r_1, r_2 and the unit vector u of their line, the direction lambda = (r_1 x u, u) gives
G_1' lambda = G_2' lambda = 0: no contact force, in or out of the friction cones, works along it. What a finger with
torsional friction gamma_i does along it is at most s_i gamma_i |u . n_i|. It is a cut that needs no solver, one per
pair, and it settles almost every pair of hard fingers for almost every W_R. In floating point the zeros are rounding
errors; they count against the cut, so that a moment that is zero but for rounding bounds nothing.
"""

from collections.abc import Iterator

import numpy as np

from planner.arrays import Floats, Indices
from planner.search.problem import SearchProblem

ROUND_OFF = 1e-14
"""Of a sum of a few products, relative to them: a few dozen times the spacing of floating point numbers."""


def pairs(problem: SearchProblem) -> Iterator[Indices]:
    """All pairs that keep kinds, spacing and span, by their first member; arrays of shape (pairs, 2)."""
    alike = len(problem.all_kinds) == 1
    for first in range(len(problem.contacts) - 1):
        partner = problem.partners(np.array([first])) & (alike | (problem.kind != problem.kind[first]))
        second = first + 1 + np.flatnonzero(partner[first + 1 :])
        yield np.stack([np.full_like(second, first), second], axis=1)


def line_bounds(problem: SearchProblem, subsets: Indices) -> Floats:
    """Upper bounds on 1 / rho of pairs, from the moment about their line.

    Args:
        problem: With two fingers in space.
        subsets: Candidate indices, shape (pairs, 2).

    Returns:
        Shape (pairs,) [1/N]; infinite where W_R asks for no moment about the line.
    """
    arms = (problem.contacts.points - problem.reference_point)[subsets]
    line = arms[:, 1] - arms[:, 0]
    length = np.linalg.norm(line, axis=1, keepdims=True)
    line = np.where(length > 0, line / np.where(length > 0, length, 1), [1.0, 0.0, 0.0])
    loads = np.abs(np.hstack([np.cross(arms[:, 0], line), line]) @ problem.wrenches.T).max(axis=1)
    forces, moments = (np.linalg.norm(part, axis=1).max() for part in np.split(problem.wrenches, 2, axis=1))
    reach = np.linalg.norm(arms, axis=2).sum(axis=1)
    along = np.abs(np.einsum("pd,pid->pi", line, problem.contacts.normals[subsets]))
    twists = problem.contacts.torsions[subsets] * along
    capacity = (problem.strengths[subsets] * (twists + ROUND_OFF * reach[:, None])).sum(axis=1)
    loads -= ROUND_OFF * (reach * forces + moments)
    bounds = np.full(len(subsets), np.inf)
    np.divide(capacity, loads, out=bounds, where=loads > 0)
    return bounds
