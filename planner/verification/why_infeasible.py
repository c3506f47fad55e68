"""Why no choice of the candidates resists the task, and what would help, in words about exactly what is proven."""

import numpy as np

from planner.arrays import Floats
from planner.contact_models.models import free_to_turn
from planner.counted import counted
from planner.grasps.grasp import Grasp
from planner.millimetres import in_mm
from planner.objects.plausibility import CANDIDATES_PER_FINGER
from planner.objects.vectors import unit
from planner.search.result import Status
from planner.verification.capacities import cut_values

MOST_LINED = 1000
"""Candidates whose lines are all compared with the load: half a million, in a fraction of a second."""

SPANNED = 1e-9
"""Relative size of a singular value below which wrenches span one dimension less."""


def hopeless_cut(grasp: Grasp) -> Floats | None:
    """A direction, shape (D,), along which even all candidates together push too little; None if no cut is one."""
    if grasp.status is not Status.INFEASIBLE:
        return None
    certificate, task = grasp.certificate, grasp.task
    candidates, cuts = certificate.candidates, certificate.cuts
    table = cut_values(candidates, task.reference_point, cuts, task.wrenches)
    hopeless = np.flatnonzero(certificate.strengths @ table * grasp.lower_bound <= 1)
    return cuts[hopeless[0]] if len(hopeless) else None


def reasons(grasp: Grasp) -> list[str]:
    """What proves that there is no grasp, where a sentence can say it."""
    cut = hopeless_cut(grasp)
    if cut is not None:
        direction = " ".join(f"{value:.3g}" for value in cut)
        return [f"direction ({direction}): no candidate can push the object along it, and the task asks for it"]
    if not _is_pair(grasp):
        return []
    moment = "hard fingers cannot resist a moment about the line through two contacts"
    if not _lines_left(grasp):
        return [f"{moment}, and this task has one about every line there is: two never hold it, wherever they are"]
    number = f"every pair of these {grasp.search.candidates} candidates" if grasp.search.candidates > 2 else "this pair"
    cuts = len(grasp.certificate.cuts)
    others = f", but for those that {counted(cuts, 'cut')} of the certificate settle" if cuts else ""
    miss = _least_miss(grasp)
    nearest = "" if miss is None else f"; the nearest line misses the load by {in_mm(miss, 2)} mm"
    return [f"{moment}, and the task has one for {number}{others}{nearest}"]


def remedies(grasp: Grasp) -> list[str]:
    """What may help."""
    helping = []
    if _is_pair(grasp):
        opposite = (
            "candidates opposite each other, so that the line through them meets the load, listed in a CSV file "
            "(--candidates); or "
        )
        helping.append(
            f"{opposite if _lines_left(grasp) else ''}fingertips that resist turning: --patch 0.004 for pads of 4 mm "
            "radius, or --torsion; or a third finger"
        )
    if grasp.search.candidates < CANDIDATES_PER_FINGER * grasp.search.fingers:
        helping.append(f"more candidates: {grasp.search.candidates} are few for {grasp.search.fingers} fingers")
    return helping


def _is_pair(grasp: Grasp) -> bool:
    """Whether it is of two fingers, neither of which resists turning wherever it is."""
    candidates = grasp.certificate.candidates
    return free_to_turn(candidates, grasp.search.fingers) and not candidates.torsions.any()


def _least_miss(grasp: Grasp) -> float | None:
    """Least moment of the task about a line through two candidates over its largest force: an arm [m].

    None where the task has no force, or where it would take long to find.
    """
    points, task = grasp.certificate.candidates.points, grasp.task
    force = np.linalg.norm(task.wrenches[:, :3], axis=1).max()
    if not force or len(points) > MOST_LINED:
        return None
    arms, least = points - task.reference_point, np.inf
    for first, arm in enumerate(arms[:-1]):
        others = arms[first + 1 :]
        lines = unit(others[(others != arm).any(axis=1)] - arm)
        turning = np.hstack([np.cross(arm, lines), lines]) @ task.wrenches.T
        least = min(least, np.abs(turning).max(axis=1).min(initial=np.inf))
    return float(least / force) if np.isfinite(least) else None


def _lines_left(grasp: Grasp) -> bool:
    """Whether two points in space could lie on a line about which the task has no moment.

    The moment of w about the line through p along u is w . (p x u, u). If the wrenches span all six dimensions, no
    line gives zero for all of them.
    """
    task = grasp.task
    length = np.linalg.norm(np.ptp(grasp.certificate.candidates.points, axis=0)) or 1.0
    values = np.linalg.svd(task.wrenches / np.repeat([1.0, length], 3), compute_uv=False)
    return int((values > SPANNED * values[0]).sum()) < 6
