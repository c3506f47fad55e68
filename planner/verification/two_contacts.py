"""What keeps two contacts in space from holding a task, however hard they press: measures over all pairs of candidates.

Let u be the unit vector from contact 1 to contact 2, d their distance.

Turning. The moment of the task about the line through both is m = max_j |(p_1 x u, u) . w_j|; no force of either
contact acts along it, and torques hold it up to s_1 gamma_1 |u . n_1| + s_2 gamma_2 |u . n_2| per newton of the level.

Opposition. Where loads of the task cancel each other, sum_j c_j w_j = 0 with c >= 0 and not zero, the same sum of the
contact forces balances itself: f at contact 1, -f at contact 2, f not zero. Torques of at most gamma_i |f| let f lean
from the line by theta, d sin(theta) <= gamma_1 + gamma_2. So f, within theta of u or of -u, is in the cone of 1, and -f
in that of 2.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from planner.arrays import Floats, Indices
from planner.grasps.grasp import Certificate
from planner.objects.vectors import unit
from planner.task import Task

MOST_PAIRED = 1000
"""Candidates of which all pairs are measured: half a million, in a fraction of a second."""

CANCELLED = 1e-9
"""Relative size of what is left of loads that cancel each other."""


@dataclass(frozen=True, kw_only=True)
class TwoContacts:
    """The best that any pair does; infinite where there is no pair of two places."""

    moment: float
    """Least moment about the line through a pair, m [N m]."""

    turning_force: float
    """Least force level at which the torques of a pair hold its m [N]; infinite for hard contacts."""

    lean: float
    """Least angle by which f would have to leave the friction cones further than its theta [rad]; at most zero where
    some pair opposes each other."""


@lru_cache(maxsize=2)
def measure_pairs(certificate: Certificate, task: Task) -> TwoContacts | None:
    """The measures over all pairs that keep kinds, spacing and span; None where there are too many candidates.

    Reasons and remedies both ask, of a grasp and of the same one with pads: the last two answers are kept.

    Args:
        certificate: Its candidates, in space.
        task: The wrenches, about its reference point.
    """
    if len(certificate.candidates) > MOST_PAIRED:
        return None
    least = np.full(3, np.inf)
    for first, others in _pairs(certificate):
        measured = _measured(certificate, task, first, others)
        least = np.minimum(least, measured.min(axis=1, initial=np.inf))
    moment, turning_force, lean = least.tolist()
    return TwoContacts(moment=moment, turning_force=turning_force, lean=lean)


def loads_cancel(wrenches: Floats, length: float) -> bool:
    """Whether zero is a convex combination of the wrenches that are not zero.

    Args:
        wrenches: Shape (l, 6) [N, N m].
        length: Makes moments comparable with forces [m].
    """
    from scipy.optimize import nnls  # here: few plans are infeasible, and all would wait for it

    loads = wrenches[wrenches.any(axis=1)] / np.repeat([1.0, length], 3)
    loads /= np.abs(loads).max()
    _, rest = nnls(np.vstack([loads.T, np.ones(len(loads))]), np.append(np.zeros(6), 1.0))
    return bool(rest <= CANCELLED)


def _pairs(certificate: Certificate) -> Iterator[tuple[int, Indices]]:
    """Every candidate, and those behind it that may be its partner."""
    points, kind = certificate.candidates.points, certificate.kind
    one_each = len(certificate.kinds) > 1
    for first in range(len(points) - 1):
        distances = np.linalg.norm(points[first + 1 :] - points[first], axis=1)
        may = (distances > 0) & (distances >= certificate.spacing) & (distances <= certificate.span)
        if one_each:
            may &= kind[first + 1 :] != kind[first]
        yield first, first + 1 + np.flatnonzero(may)


def _measured(certificate: Certificate, task: Task, first: int, others: Indices) -> Floats:
    """Moment, turning force and lean of the pairs of one candidate with others, shape (3, others)."""
    contacts, strengths = certificate.candidates, certificate.strengths
    arm, torsions, cones = contacts.points - task.reference_point, contacts.torsions, np.arctan(contacts.friction)
    apart = arm[others] - arm[first]
    line, distance = unit(apart), np.linalg.norm(apart, axis=1)
    moment = np.abs(np.hstack([np.cross(arm[first], line), line]) @ task.wrenches.T).max(axis=1)
    here, there = line @ contacts.normals[first], -(line * contacts.normals[others]).sum(axis=1)
    twist = strengths[first] * torsions[first] * np.abs(here) + strengths[others] * torsions[others] * np.abs(there)
    force = np.divide(moment, twist, out=np.full(len(others), np.inf), where=twist > 0)
    force[moment == 0] = 0.0
    theta = np.arcsin(np.minimum(1.0, (torsions[first] + torsions[others]) / distance))
    inward, outward = (  # pressing towards each other, or apart, inside a ring
        np.maximum(_angle(sign * here) - cones[first], _angle(sign * there) - cones[others]) for sign in (1, -1)
    )
    return np.stack([moment, force, np.minimum(inward, outward) - theta])


def _angle(cosine: Floats) -> Floats:
    return np.arccos(np.clip(cosine, -1, 1))
