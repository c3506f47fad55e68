"""Why no choice of the candidates resists the task, and what would help, in words about exactly what is proven."""

import numpy as np

from planner.arrays import Floats
from planner.contact_models.models import free_to_turn
from planner.counted import counted
from planner.grasps.grasp import Grasp
from planner.millimetres import in_mm
from planner.objects.plausibility import CANDIDATES_PER_FINGER
from planner.search.result import Status
from planner.verification.capacities import cut_values
from planner.verification.two_contacts import TwoContacts, loads_cancel, measure_pairs

PAD = 0.004
"""Radius of the pads that two hard fingers are said to be helped by [m]: those of common grippers."""

SEEN_LEAN = np.deg2rad(0.01)
"""Least angle that is worth a word [rad]."""

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
        twist = " or twist" if grasp.certificate.candidates.torsions.any() else ""
        return [f"direction ({direction}): no candidate can push{twist} the object along it, and the task asks for it"]
    if is_hard_pair(grasp):
        return [_hard_pair(grasp)]
    pair = _soft_pair(grasp)
    return [] if pair is None else [*_turns(grasp, pair), *_opposes(grasp, pair)]


def remedies(grasp: Grasp, with_pads: Grasp | None = None) -> list[str]:
    """What may help.

    Args:
        grasp: The infeasible one.
        with_pads: The same of two hard fingers, planned with pads of radius PAD; None where that was not tried.
    """
    helping = []
    if is_hard_pair(grasp):
        if _lines_left(grasp):
            helping.append(
                "candidates opposite each other, so that the line through them meets the load (--candidates "
                "antipodal:300), or listed in a CSV file"
            )
        helping += [_pads(grasp, with_pads), "a third finger"]
    elif (pair := _soft_pair(grasp)) is not None:
        if _turns(grasp, pair):
            helping.append("fingertips that resist turning more: larger pads (--patch) or a larger --torsion")
        if _opposes(grasp, pair):
            helping.append(
                "candidates opposite each other: more of them (--candidates antipodal:3000), or listed in a CSV file"
            )
        helping.append("a third finger")
    if grasp.search.candidates < CANDIDATES_PER_FINGER * grasp.search.fingers:
        helping.append(f"more candidates: {grasp.search.candidates} are few for {grasp.search.fingers} fingers")
    return helping


def is_hard_pair(grasp: Grasp) -> bool:
    """Whether it is infeasible, and of two fingers neither of which resists turning wherever it is."""
    candidates = grasp.certificate.candidates
    infeasible = grasp.status is Status.INFEASIBLE
    return infeasible and free_to_turn(candidates, grasp.search.fingers) and not candidates.torsions.any()


def _hard_pair(grasp: Grasp) -> str:
    """Why two hard fingers fail."""
    moment = "hard fingers cannot resist a moment about the line through two contacts"
    if not _lines_left(grasp):
        return f"{moment}, and this task has one about every line there is: two never hold it, wherever they are"
    number = f"every pair of these {grasp.search.candidates} candidates" if grasp.search.candidates > 2 else "this pair"
    cuts = len(grasp.certificate.cuts)
    others = f", but for those that {counted(cuts, 'cut')} of the certificate settle" if cuts else ""
    pair, force = measure_pairs(grasp.certificate, grasp.task), _largest_force(grasp)
    nearest = ""
    if pair is not None and force and np.isfinite(pair.moment):
        nearest = f"; the nearest line misses the load by {in_mm(pair.moment / force, 2)} mm"
    return f"{moment}, and the task has one for {number}{others}{nearest}"


def _pads(grasp: Grasp, with_pads: Grasp | None) -> str:
    """What fingertips that twist would do."""
    given = f"--patch {PAD:g} (pads of {in_mm(PAD)} mm radius)"
    if with_pads is not None and with_pads.status is Status.INFEASIBLE:
        why = "".join(f": {reason}" for reason in reasons(with_pads)[:1])
        return f"other candidates; even with {given} no two of these hold it{why}"
    least = _least_torsion(grasp)
    if with_pads is not None and with_pads.found:
        most = "" if with_pads.status is Status.OPTIMAL else " or less"
        held = f"two of these candidates hold it with {with_pads.rho:.3g} N{most}"
        return f"fingertips that resist turning: with {given} {held}{least}"
    return f"fingertips that resist turning: {given}, or --torsion{least}"


def _least_torsion(grasp: Grasp) -> str:
    """What two fingers need of torsion and force, which together hold the moment that is left about any line."""
    pair = measure_pairs(grasp.certificate, grasp.task)
    if pair is None or not 0 < pair.moment < np.inf:
        return ""
    return f"; torsion times force must be {_rounded_down(500 * pair.moment)} N mm or more"


def _soft_pair(grasp: Grasp) -> TwoContacts | None:
    """Measures of two fingers in space of which some resist turning; None for others, or where it would take long."""
    candidates, two = grasp.certificate.candidates, grasp.search.fingers == 2
    if grasp.status is not Status.INFEASIBLE or not two or not candidates.torsions.any():
        return None
    return measure_pairs(grasp.certificate, grasp.task)


def _turns(grasp: Grasp, pair: TwoContacts) -> list[str]:
    """The moment about the line, where all pairs resist it too weakly."""
    if not pair.turning_force >= grasp.lower_bound:
        return []
    most = in_mm(grasp.certificate.candidates.torsions.max(), 3)
    return [
        "the task has a moment about the line through every pair of contacts, which torsional friction of at most "
        f"{most} mm does not hold with less than {_rounded_down(pair.turning_force)} N"
    ]


def _opposes(grasp: Grasp, pair: TwoContacts) -> list[str]:
    """The line through the contacts, where all pairs have it outside their cones and the loads ask for it inside."""
    points, task = grasp.certificate.candidates.points, grasp.task
    if not SEEN_LEAN <= pair.lean < np.inf or not loads_cancel(task.wrenches, _length(points)):
        return []
    return [
        "loads of this task cancel each other, so two fingers must press against each other, along a line in both "
        f"friction cones or nearly so; the nearest of these pairs misses that by {np.rad2deg(pair.lean):.2g}°"
    ]


def _lines_left(grasp: Grasp) -> bool:
    """Whether two points in space could lie on a line about which the task has no moment.

    The moment of w about the line through p along u is w . (p x u, u). If the wrenches span all six dimensions, no
    line gives zero for all of them.
    """
    scale = np.repeat([1.0, _length(grasp.certificate.candidates.points)], 3)
    values = np.linalg.svd(grasp.task.wrenches / scale, compute_uv=False)
    return int((values > SPANNED * values[0]).sum()) < 6


def _length(points: Floats) -> float:
    """Makes moments comparable with forces [m]."""
    return float(np.linalg.norm(np.ptp(points, axis=0))) or 1.0


def _largest_force(grasp: Grasp) -> float:
    """Of the task [N]."""
    return float(np.linalg.norm(grasp.task.wrenches[:, :3], axis=1).max())


def _rounded_down(value: float, digits: int = 2) -> str:
    """To so many significant digits, never more than the value, which is positive."""
    unit = 10.0 ** (np.floor(np.log10(value)) - digits + 1)
    return f"{np.floor(value / unit) * unit:.{digits}g}"
