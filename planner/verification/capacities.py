"""What one newton at a contact does along a cut: the support functions of the contact models, in closed form.

Written without the search's, from other formulas; the two are compared in the tests.
"""

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts


def cut_values(contacts: Contacts, reference_point: Floats, cuts: Floats, wrenches: Floats) -> Floats:
    """a_i(lambda_k): what one newton at contact i does along lambda_k, per unit of what W_R asks along it.

    Args:
        contacts: n of them; how strong their fingers are does not matter.
        reference_point: p_o, shape (d,) [m].
        cuts: Directions lambda, shape (cuts, D).
        wrenches: Vertices of W_R about p_o, shape (l, D) [N, N m].

    Returns:
        Shape (n, cuts) [1/N]; infinite for directions along which W_R asks nothing.
    """
    arms, normals, friction = contacts.points - reference_point, contacts.normals, contacts.friction
    soft = np.flatnonzero(contacts.torsions)
    table = np.full((len(arms), len(cuts)), np.inf)
    for k, cut in enumerate(cuts):
        asked = float((-(wrenches @ cut)).max())
        if asked <= 0:
            continue
        if contacts.dimension == 2:
            velocity = cut[:2] + cut[2] * np.stack([-arms[:, 1], arms[:, 0]], axis=1)
        else:
            velocity = cut[:3] + np.cross(cut[3:], arms)
        along = np.einsum("id,id->i", velocity, normals)
        across = np.linalg.norm(velocity - along[:, None] * normals, axis=1)
        table[:, k] = hard_capacity(along, across, friction) / asked
        if len(soft):
            spin = np.abs(normals[soft] @ cut[3:]) * contacts.torsions[soft]
            table[soft, k] = soft_capacity(along[soft], across[soft], spin, friction[soft]) / asked
    return table


def hard_capacity(along: Floats, across: Floats, friction: Floats) -> Floats:
    """max v.f over |f_t| <= mu f_n, |f| <= 1, shape (n,).

    With theta the angle between v and the normal, and alpha = atan(mu): |v| where theta <= alpha, else
    |v| cos(theta - alpha), never below zero.

    Args:
        along: Normal component of v, shape (n,).
        across: Length of its tangential part, shape (n,).
        friction: mu, shape (n,).
    """
    outside = np.maximum(np.arctan2(across, along) - np.arctan(friction), 0.0)
    return np.hypot(along, across) * np.maximum(np.cos(np.minimum(outside, np.pi / 2)), 0.0)


def soft_capacity(along: Floats, across: Floats, spin: Floats, friction: Floats) -> Floats:
    """max v.f + omega tau over |f_t|^2 / mu^2 + tau^2 / gamma^2 <= f_n^2, |f| <= 1, shape (n,).

    By duality this is the minimum over 0 <= y <= b of hypot(max(0, a + hypot(mu y, k)), b - y), and every y gives a
    value that is not below it: so the bounds that this table proves are true however exact y is. At the minimum
    u = (1 + mu^2) y / b is a root of

        (1 - u)^2 (u^2 + K^2) = A^2 u^2,        A = mu a / b,    K = (1 + mu^2) k / (mu b),

    that below 1 where a > 0, else that above. Ferrari's resolvent is w^3 + (1 + K^2 - A^2) w = 2 |A| K, and with its
    largest root w and R = sqrt(1 + w^2)

        u = (1 + R -+ sqrt(2 (A^2 + K^2) / R - 2 (K^2 - A^2) - w^2)) / 2.

    Args:
        along: a, normal component of v, shape (n,).
        across: b, length of its tangential part, shape (n,).
        spin: k = gamma |omega|, what a newton of normal force does by twisting alone, shape (n,).
        friction: mu, shape (n,).
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # where b is nothing, so is y
        square = 1 + friction * friction
        A, K = friction * np.abs(along) / across, square * spin / (friction * across)
        w = _largest_root(1 + K * K - A * A, 2 * A * K)
        R = np.sqrt(1 + w * w)
        width = np.sqrt(np.maximum(2 * (A * A + K * K) / R - 2 * (K * K - A * A) - w * w, 0))
        u = (1 + R - np.sign(along) * width) / 2
        y = np.nan_to_num(np.clip(across * u / square, 0, across))
    return np.min(
        [
            np.hypot(np.maximum(along + np.hypot(friction * each, spin), 0), across - each)
            for each in (y, across, 0 * across)
        ],
        axis=0,
    )


def _largest_root(E: Floats, L: Floats) -> Floats:
    """w of w^3 + E w = L, L >= 0, by Cardano, written so that no digits cancel; shape of both."""
    third = E / 3
    bend = (L / 2) ** 2 + third**3
    one = np.cbrt(L / 2 + np.sqrt(np.maximum(bend, 0)))
    other = third / np.where(one == 0, 1, one)
    single = L / (one * one + third + other * other)
    lengths = np.sqrt(np.maximum(-third, 0))
    threefold = 2 * lengths * np.cos(np.arccos(np.clip(L / 2 / lengths**3, 0, 1)) / 3)
    return np.where(bend >= 0, single, threefold)
