"""Are the candidates all those of the choice that is named, and no others? Chosen again, and compared as sets.

The choice, MuJoCo's confirmation, the limits and the kinds of fingers are no part of the search, so they are repeated
by the code that made them. A candidate is its point, its normal, its friction, its torsional friction and the kind of
finger it is for.
"""

from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from planner.candidates.candidates import CandidateChoice, Candidates
from planner.candidates.choice import make_candidates, repeatable
from planner.candidates.confirmed import confirmed_candidates
from planner.errors import RhograspError
from planner.files.source_file import SourceFile
from planner.grasps.grasp import Certificate, Grasp
from planner.limits.kinds import finger_kinds
from planner.limits.limits import Limits
from planner.limits.limits_file import read_limits
from planner.limits.restricted import restricted
from planner.objects.graspable import Graspable
from planner.objects.rigid_object import RigidObject
from planner.search.finger_kind import FingerKind
from planner.verification.check import Check, checked, not_checked
from planner.verification.provenance.mass import NO_OBJECT

SAME = 1e-7
"""By less, the same candidates differ: points and distances relative to the object's size, the rest as it is."""

DECIDING = ("rhograsp", "mujoco", "numpy", "scipy")
"""Packages of whose other versions other candidates may come."""


def check_choice(grasp: Grasp, rigid_object: Graspable | None) -> Check:
    """The candidates are chosen again, where that can be done, and compared."""
    choice = grasp.candidate_choice
    if choice is None:
        return not_checked("no candidate was left out or added", "how they were chosen is not recorded")
    file = _file(choice)
    source = f"the choice '{choice.candidates}'" if file is None else f"the file {file.path}"
    claim = f"the candidates are those of {source}{_filters(choice)}"
    if obstacle := _obstacle(choice):
        return not_checked(claim, obstacle)
    if rigid_object is None:
        return not_checked(claim, NO_OBJECT)
    changed = "".join(f"{source.path} has changed since; " for source in _sources(choice) if not source.unchanged)
    others = [name for name in DECIDING if grasp.packages.get(name) != version(name)]
    try:
        check = _compared(claim, grasp, choice, rigid_object)
    except RhograspError as error:
        return checked(claim, False, f"{changed}they cannot be chosen again: {error}")
    if check.fails and others:
        versions = ", ".join(f"{name} {grasp.packages.get(name)} (here {version(name)})" for name in others)
        return not_checked(claim, f"{changed}{check.detail}; but they were chosen with {versions}")
    return Check(claim=claim, result=check.result, detail=f"{changed}{check.detail}")


def _filters(choice: CandidateChoice) -> str:
    """What else decided which candidates there are, in words."""
    confirmed = ", confirmed by MuJoCo" if choice.confirmed else ""
    if choice.limits is not None:
        return f"{confirmed}, within the limits of {choice.limits.path}"
    return f"{confirmed}, within limits" if choice.limited else confirmed


def _sources(choice: CandidateChoice) -> list[SourceFile]:
    return [source for source in (_file(choice), choice.limits) if source is not None]


def _file(choice: CandidateChoice) -> SourceFile | None:
    """The file of points; a choice that needs none has none, whatever else is recorded."""
    return None if repeatable(choice.candidates) else choice.file


def _obstacle(choice: CandidateChoice) -> str | None:
    """Why the choice cannot be repeated, if it cannot."""
    if choice.file is None and not repeatable(choice.candidates):
        return "the file of points is not recorded"
    absent = [source.path for source in _sources(choice) if not source.there]
    return f"{', '.join(absent)} is not there" if absent else None


def _compared(claim: str, grasp: Grasp, choice: CandidateChoice, rigid_object: Graspable) -> Check:
    """The recorded candidates against those that the choice gives today."""
    recorded, chosen = grasp.certificate, _chosen(choice, rigid_object)
    if choice.confirmed is None or choice.limited is None or (choice.limited and choice.limits is None):
        return _among(claim, recorded, chosen, choice, rigid_object.size)
    again = _allowed(chosen, choice, grasp.search.fingers, rigid_object)
    difference = _difference(recorded, again, rigid_object.size) or _distances(recorded, again, rigid_object.size)
    return checked(claim, not difference, difference or f"chosen again: the same {len(again.candidates)}")


def _among(claim: str, recorded: Certificate, chosen: Candidates, choice: CandidateChoice, size: float) -> Check:
    """Where it is not recorded what removed candidates: some may be missing, but none may be of another choice."""
    own = choice.limited is True  # limits also say how fingers twist
    stated, given = (replace(each, torsion=None) if own else each for each in (recorded.candidates, chosen.contacts))
    points = Certificate(candidates=stated, cuts=recorded.cuts)
    again = Certificate(candidates=given, cuts=recorded.cuts)
    foreign, missing = _unlike(points, again, size), _unlike(again, points, size)
    if foreign:
        return checked(claim, False, f"{foreign} of {len(recorded.candidates)} are not of this choice")
    if own:
        twist = ", and given fingers their torsional friction," if recorded.candidates.torsions.any() else ""
        why = f"the limits that may have removed {missing} others{twist} are the caller's own"
    elif missing or recorded.kinds or recorded.spacing or np.isfinite(recorded.span):
        why = f"whether limits or MuJoCo removed {missing} others is not recorded"
    else:
        return checked(claim, True, f"chosen again: the same {len(again.candidates)}")
    return not_checked(claim, f"all are of this choice; {why}")


def _chosen(choice: CandidateChoice, rigid_object: Graspable) -> Candidates:
    """The candidates before limits."""
    file = _file(choice)
    words = choice.candidates if file is None else file.path
    candidates = make_candidates(rigid_object, words, choice.friction, choice.seed, choice.fingertip)
    candidates = candidates.twisting(choice.torsion, choice.patch).least_friction(choice.friction_error)
    if choice.confirmed and isinstance(rigid_object, RigidObject):
        return confirmed_candidates(rigid_object, candidates).candidates
    return candidates


def _allowed(candidates: Candidates, choice: CandidateChoice, fingers: int, rigid_object: Graspable) -> Certificate:
    """What the limits leave for each kind of finger, and at which distances."""
    limits = Limits() if choice.limits is None else read_limits(Path(choice.limits.path), rigid_object)
    kinds = finger_kinds(rigid_object, restricted(rigid_object, candidates, limits).candidates, fingers, limits)
    return Certificate(
        candidates=kinds.candidates.contacts,
        cuts=np.empty(0),
        kinds=kinds.kinds,
        spacing=limits.spacing,
        span=limits.span,
    )


def _distances(recorded: Certificate, again: Certificate, size: float) -> str:
    """How kinds of fingers, spacing and span differ, if they do."""
    if recorded.kinds != again.kinds:
        return f"the fingers are {_fingers(recorded.kinds)}; they should be {_fingers(again.kinds)}"
    for name in ("spacing", "span"):
        stated, asked = getattr(recorded, name), getattr(again, name)
        if stated != asked and not abs(stated - asked) <= SAME * size:
            return f"{name} is {stated:g} m, it should be {asked:g} m"
    return ""


def _fingers(kinds: tuple[FingerKind, ...]) -> str:
    """Kinds of fingers in words."""
    return ", ".join(f"{kind.fingers} of strength {kind.strength:g}" for kind in kinds) or "all alike"


def _difference(recorded: Certificate, again: Certificate, size: float) -> str:
    """How many candidates differ, if any do."""
    foreign, missing = _unlike(recorded, again, size), _unlike(again, recorded, size)
    if foreign or missing or len(recorded.candidates) != len(again.candidates):
        return (
            f"{len(recorded.candidates)} candidates, {foreign} not of this choice; it gives {len(again.candidates)}, "
            f"{missing} of them missing"
        )
    return ""


def _unlike(some: Certificate, others: Certificate, size: float) -> int:
    """How many of some candidates are not among others."""
    tables = [
        np.column_stack(
            [
                *(each.candidates.points / size, each.candidates.normals, each.candidates.friction),
                *(each.candidates.torsions / size, each.kind),
            ]
        )
        for each in (some, others)
    ]
    distances, _ = cKDTree(tables[1]).query(tables[0], p=np.inf, distance_upper_bound=SAME)
    return int(np.isinf(distances).sum())
