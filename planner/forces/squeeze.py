"""The passive squeeze: the least largest force of fingers that push constantly and yield like springs.

Every finger pushes with a constant preload p_i and its tip gives way with the same stiffness K in all directions;
nothing knows the wrench. A wrench w moves the rigid object by a small twist ξ (displacement of p_o, rotation); a tip
that sticks follows its contact, q_i = G_i^T ξ, and the contact force becomes f_i = p_i - K q_i. Before the wrench
the preloads balance, sum_i G_i p_i = 0, and under it sum_i G_i f_i = -w, so that

    ξ = (K sum_i G_i G_i^T)^+ w,        f_i(w) = p_i - r_i(w),    r_i(w) = G_i^T (sum_k G_k G_k^T)^+ w,

whatever K is: springs share a wrench with the least sum of squares. The need is one second-order cone program in
the preloads alone, which serve the unloaded grasp and all wrenches at once:

    squeeze_force = min s   s.t.   p_i - r_i(w) in K_i,   |p_i - r_i(w)| <= s   for every w in {0, w_1, ..., w_l}.

It is not rho: rho lets the forces answer each wrench as they like, so rho <= squeeze_force. The conditions are
convex in w, so between the vertices of W_R, and on the way from no load, they hold too. Above the need, preloads
scaled in proportion hold as well: they lie in the cones by themselves.

Small twists mean w << K R0 and p << K R0; a soft spring turns the grasp under its own preload.
"""

from dataclasses import dataclass

import clarabel
import numpy as np
from scipy import sparse
from scipy.linalg import null_space

from planner.arrays import Floats
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contacts import Contacts, contact_frames, reach, wrench_scale
from planner.errors import ContactError, SolverError
from planner.forces.contact_program import INFEASIBLE, SOLVED

RANGE_TOLERANCE = 1e-9
"""A wrench is out of reach of the fingers when this part of it remains unbalanced."""
SERVED = 1e-7
"""Preloads serve a wrench when no force leaves its cone or exceeds the cap by more, relative to the largest share."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SqueezeNeed:
    """Predicted need of a passive squeeze. Body frame, SI. Not rho, and never less than it."""

    squeeze_force: float
    """Largest contact force of any finger under any wrench, as small as constant preloads allow [N]; infinite if no
    preload holds every wrench."""

    preload: Floats
    """Constant push p_i of each finger, an internal force, shape (contacts, d) [N]; NaN if there is none."""

    forces: Floats
    """Contact forces f_i(w) under each wrench, shape (wrenches, contacts, d) [N]; NaN if there are none."""

    @property
    def feasible(self) -> bool:
        """Whether some constant preload holds every wrench."""
        return bool(np.isfinite(self.squeeze_force))


def squeeze_need(contacts: Contacts, reference_point: Floats, wrenches: Floats) -> SqueezeNeed:
    """Least largest force of a constant preload with equal springs.

    Args:
        contacts: The grasp.
        reference_point: p_o, shape (d,) [m].
        wrenches: Vertices of W_R about p_o, shape (wrenches, D) [N, N m].

    Raises:
        ContactError: When a finger's strength is not 1, or it has torsional friction.
        SolverError: When Clarabel stops without an optimum or a certificate.
    """
    if (contacts.strengths != 1).any():
        raise ContactError(
            f"the fingers have strengths {contacts.strengths.tolist()}; what a squeeze needs is defined for fingers of "
            "strength 1: measure this grasp with fingers that adapt"
        )
    if contacts.torsions.any():
        raise ContactError(
            "the fingers have torsional friction; what a squeeze needs is defined for tips that give way to every push "
            "alike, and how far one yields to a twist is not known: measure this grasp with fingers that adapt"
        )
    fingers, d = contacts.points.shape
    frames = contact_frames(contacts.normals)
    scale = wrench_scale(d, reach(contacts.points, reference_point))
    maps = scale[:, None] * HARD_FINGER.maps(contacts, reference_point)
    stacked = maps.transpose(1, 0, 2).reshape(len(scale), fingers * d)
    loads = scale * wrenches
    shares = loads @ np.linalg.pinv(stacked).T
    if np.abs(shares @ stacked.T - loads).max() > RANGE_TOLERANCE * np.abs(loads).max():
        return _impossible(wrenches, contacts)
    unit = float(np.abs(shares).max()) or 1.0
    responses = np.vstack([np.zeros(fingers * d), -shares / unit]).reshape(-1, fingers, d)
    internal = null_space(stacked).reshape(fingers, d, -1)
    weights = _least_weights(internal, responses, contacts.friction) if shares.any() else np.zeros(internal.shape[2])
    if weights is None:
        return _impossible(wrenches, contacts)
    preload = unit * np.einsum("ide,iek,k->id", frames, internal, weights)
    forces = preload + unit * np.einsum("ide,jie->jid", frames, responses[1:])
    largest = max(np.linalg.norm(preload, axis=1).max(), np.linalg.norm(forces, axis=2).max())
    return SqueezeNeed(squeeze_force=float(largest), preload=preload, forces=forces)


def _impossible(wrenches: Floats, contacts: Contacts) -> SqueezeNeed:
    nowhere = np.full((len(wrenches), *contacts.points.shape), np.nan)
    return SqueezeNeed(squeeze_force=np.inf, preload=nowhere[0], forces=nowhere)


def _least_weights(internal: Floats, responses: Floats, friction: Floats) -> Floats | None:
    """Weights z of the internal forces, p = N z, with the least largest force; None if there are none.

    Few wrenches bind. The program is solved for some of them; those that its answer serves worst join, finger by
    finger, until it serves all: the exact optimum, at 4,096 wrenches in a fraction of a second instead of a minute.

    Args:
        internal: Basis N of the internal forces in contact frames, shape (m, d, k).
        responses: Change of the contact forces per wrench, in contact frames, the first none, shape (l, m, d).
        friction: Shape (m,).

    Raises:
        SolverError: When Clarabel stops without an optimum or a certificate.
    """
    binding = np.union1d(0, np.linalg.norm(responses, axis=2).argmax(axis=0))
    for _ in range(len(responses)):  # every round but the last adds one or more
        solution = _solve(internal, responses[binding], friction)
        if solution is None:
            return None
        weights, cap = solution
        forces = internal @ weights + responses
        beyond_cone = np.linalg.norm(forces[..., 1:], axis=2) - friction * forces[..., 0]
        excess = np.concatenate([beyond_cone, np.linalg.norm(forces, axis=2) - cap], axis=1)
        unserved = np.setdiff1d(excess.argmax(axis=0)[excess.max(axis=0) > SERVED], binding)
        if not unserved.size:
            break
        binding = np.union1d(binding, unserved)
    return weights


def _solve(internal: Floats, responses: Floats, friction: Floats) -> tuple[Floats, float] | None:
    """Weights and the largest force for these wrenches alone; None if there are none.

    Clarabel's form A x + s = b with x = (z, cap); per wrench and finger the slack s is (mu f_n, f_t) in a
    second-order cone, then (cap, f) in another, with f = N_i z + response.
    """
    fingers, d, count = internal.shape
    rows, bounds = np.zeros((fingers, 2 * d + 1, count + 1)), np.zeros((len(responses), fingers, 2 * d + 1))
    slopes = np.ones((fingers, d))
    slopes[:, 0] = friction
    rows[:, :d, :count], bounds[:, :, :d] = -slopes[:, :, None] * internal, slopes * responses
    rows[:, d, count] = -1.0
    rows[:, d + 1 :, :count], bounds[:, :, d + 1 :] = -internal, responses
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    solution = clarabel.DefaultSolver(
        sparse.csc_matrix((count + 1, count + 1)),
        np.append(np.zeros(count), 1.0),
        sparse.csc_matrix(np.tile(rows.reshape(-1, count + 1), (len(responses), 1))),
        bounds.ravel(),
        [clarabel.SecondOrderConeT(d), clarabel.SecondOrderConeT(d + 1)] * (len(responses) * fingers),
        settings,
    ).solve()
    if solution.status in INFEASIBLE:
        return None
    if solution.status not in SOLVED:
        raise SolverError(
            f"Clarabel stopped with status {solution.status} on the squeeze of {fingers} fingers, neither an optimum "
            "nor a proof that there is none; this grasp holds some wrench barely or barely not"
        )
    x = np.asarray(solution.x)
    return x[:count], float(x[count])
