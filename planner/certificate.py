"""Does a set of cuts prove a bound on rho for every subset? Checked without a solver and without the search.

The claim: for every m-subset N, min_k sum_{i in N} a_i(lambda_k) <= 1 / bound. It is settled by enumeration when
there are few subsets, otherwise by halving groups of candidates until every combination of groups is covered by
one cut. For two fingers in space the moment about the line through the pair counts as one more cut.
"""

from dataclasses import dataclass
from math import comb

import numpy as np

from planner.grasp import Certificate

MOST_ENUMERATED = 20_000_000
"""Subsets up to which enumeration is used."""

SMALL_GROUP = 8
"""Groups up to this size are looked up afresh: remembering them all would double the memory of the table."""

ROUNDING = 1e-9
"""Relative slack for the rounding of a sum of a few numbers."""


@dataclass(frozen=True, kw_only=True)
class BoundCheck:
    """Outcome of checking a certificate."""

    proven: bool

    method: str
    """`enumeration` or `groups`."""

    counterexample: tuple[int, ...] = ()
    """A subset that no cut covers."""


def check_bound(
    certificate: Certificate, fingers: int, reference_point: np.ndarray, wrenches: np.ndarray, bound: float
) -> BoundCheck:
    """Check that no subset of the candidates has rho below a bound.

    Args:
        certificate: Candidates and cuts.
        fingers: Size m of the subsets.
        reference_point: p_o, shape (d,) [m].
        wrenches: Vertices of W_R, shape (l, D) [N, N m].
        bound: Claimed lower bound on rho [N].
    """
    points, normals = certificate.candidates.points, certificate.candidates.normals
    arms = points - reference_point
    table = capacities(arms, normals, certificate.candidates.friction, certificate.cuts, wrenches)
    most = (1 + ROUNDING) / bound
    if fingers == 2 and points.shape[1] == 3:
        return _check_pairs(table, arms, wrenches, most)
    if comb(len(points), fingers) <= MOST_ENUMERATED:
        return _enumerate(table, fingers, most)
    return _halve_groups(table, points, fingers, most)


def capacities(
    arms: np.ndarray, normals: np.ndarray, friction: np.ndarray, cuts: np.ndarray, wrenches: np.ndarray
) -> np.ndarray:
    """a_i(lambda_k): what one newton at contact i does along lambda_k, per unit of what W_R asks along it.

    With theta the angle between the contact's velocity v = lambda_f + lambda_m x r and its normal, and
    alpha = atan(mu): |v| where theta <= alpha, else |v| cos(theta - alpha), never below zero.

    Args:
        arms: r_i = p_i - p_o, shape (n, d) [m].
        normals: Inward unit normals, shape (n, d).
        friction: Shape (n,).
        cuts: Directions lambda, shape (cuts, D).
        wrenches: Vertices of W_R, shape (l, D).

    Returns:
        Shape (n, cuts) [1/N]; infinite for directions along which W_R asks nothing.
    """
    dimension = arms.shape[1]
    table = np.full((len(arms), len(cuts)), np.inf)
    for k, cut in enumerate(cuts):
        asked = float((-(wrenches @ cut)).max())
        if asked <= 0:
            continue
        if dimension == 2:
            velocity = cut[:2] + cut[2] * np.stack([-arms[:, 1], arms[:, 0]], axis=1)
        else:
            velocity = cut[:3] + np.cross(cut[3:], arms)
        along = np.einsum("id,id->i", velocity, normals)
        across = np.linalg.norm(velocity - along[:, None] * normals, axis=1)
        outside = np.maximum(np.arctan2(across, along) - np.arctan(friction), 0.0)
        table[:, k] = np.hypot(along, across) * np.maximum(np.cos(np.minimum(outside, np.pi / 2)), 0.0) / asked
    return table


def _enumerate(table: np.ndarray, fingers: int, most: float) -> BoundCheck:
    """All subsets, the last member of each vectorised."""
    count = len(table)

    def uncovered(prefix: tuple[int, ...], sums: np.ndarray) -> tuple[int, ...]:
        first = prefix[-1] + 1 if prefix else 0
        if len(prefix) == fingers - 1:
            best = (sums + table[first:]).min(axis=1, initial=np.inf)
            return (*prefix, first + int(best.argmax())) if best.max(initial=0.0) > most else ()
        for member in range(first, count - (fingers - len(prefix)) + 1):
            found = uncovered((*prefix, member), sums + table[member])
            if found:
                return found
        return ()

    counterexample = uncovered((), np.zeros(table.shape[1]))
    return BoundCheck(proven=not counterexample, method="enumeration", counterexample=counterexample)


def _halve_groups(table: np.ndarray, points: np.ndarray, fingers: int, most: float) -> BoundCheck:
    """Combinations of groups of neighbouring candidates; a group is a run of `table` sorted by repeated halving."""
    order = _neighbour_order(points)
    table = table[order]
    best: dict[tuple[int, int], np.ndarray] = {}

    def maximum(group: tuple[int, int]) -> np.ndarray:
        start, stop = group
        if stop - start <= SMALL_GROUP:
            return table[start:stop].max(axis=0)
        if group not in best:
            best[group] = table[start:stop].max(axis=0)
        return best[group]

    stack = [((0, len(table)),) * fingers]
    while stack:
        groups = stack.pop()
        if np.sum([maximum(group) for group in groups], axis=0).min(initial=np.inf) <= most:
            continue
        start, stop = max(groups, key=lambda group: group[1] - group[0])
        if stop - start == 1:
            subset = tuple(sorted(int(order[group[0]]) for group in groups))
            return BoundCheck(proven=False, method="groups", counterexample=subset)
        others = [group for group in groups if group != (start, stop)]
        copies, middle = fingers - len(others), (start + stop) // 2
        stack.extend(
            (*others, *[(start, middle)] * low, *[(middle, stop)] * (copies - low))
            for low in range(copies + 1)
            if low <= middle - start and copies - low <= stop - middle
        )
    return BoundCheck(proven=True, method="groups")


def _neighbour_order(points: np.ndarray) -> np.ndarray:
    """Candidates sorted so that every run made by repeated halving lies close together."""
    order = np.arange(len(points))
    stack = [(0, len(points))]
    while stack:
        start, stop = stack.pop()
        if stop - start < 2:
            continue
        run = order[start:stop]
        axis = np.ptp(points[run], axis=0).argmax()
        order[start:stop] = run[np.argsort(points[run, axis], kind="stable")]
        middle = (start + stop) // 2
        stack += [(start, middle), (middle, stop)]
    return order


def _check_pairs(table: np.ndarray, arms: np.ndarray, wrenches: np.ndarray, most: float) -> BoundCheck:
    """All pairs of contacts in space: covered by a cut, or by the moment W_R asks about their line."""
    for first in range(len(arms) - 1):
        best = (table[first] + table[first + 1 :]).min(axis=1, initial=np.inf)
        others = first + 1 + np.flatnonzero(best > most)
        open_ = others[_turning(arms[first], arms[others], wrenches) > most]
        if len(open_):
            return BoundCheck(proven=False, method="enumeration", counterexample=(first, int(open_[0])))
    return BoundCheck(proven=True, method="enumeration")


def _turning(arm: np.ndarray, arms: np.ndarray, wrenches: np.ndarray) -> np.ndarray:
    """Bounds on 1 / rho of one contact paired with others, from the moment about their line, shape (others,) [1/N].

    A contact does at most |v| along a direction that moves it with velocity v; here v is zero but for rounding.
    """
    lines = np.where((arms == arm).all(axis=1, keepdims=True), [1.0, 0.0, 0.0], arms - arm)
    forces = np.cross(arm, lines)
    asked = np.abs(forces @ wrenches[:, :3].T + lines @ wrenches[:, 3:].T).max(axis=1)
    velocities = np.linalg.norm(forces + np.cross(lines, arm), axis=1) + np.linalg.norm(
        forces + np.cross(lines, arms), axis=1
    )
    return np.divide(velocities, asked, out=np.full(len(arms), np.inf), where=asked > 0)
