"""Does a grasp file agree with itself? Whether what it says is true is the business of `planner.verification`."""

import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension
from planner.errors import GraspFileError
from planner.grasps.document import GraspDocument
from planner.grasps.grasp import Grasp, ProofCheck, SearchRecord
from planner.search.problem import MOST_FINGERS

AGREEMENT = 1e-6
"""Relative accuracy to which numbers stored twice must agree."""


def check_agreement(document: GraspDocument, grasp: Grasp) -> None:
    """Check that the parts of a file fit each other.

    Args:
        document: The file.
        grasp: What it says, as arrays.

    Raises:
        GraspFileError: Where numbers that it states twice disagree, or are out of range.
    """
    size = wrench_dimension(grasp.certificate.candidates.dimension)
    if grasp.task.wrenches.shape[1] != size:
        raise GraspFileError(f"wrenches must have {size} numbers each")
    if not np.isfinite(grasp.certificate.cuts).all():
        raise GraspFileError("a cut is not finite")
    if not 1 <= grasp.search.fingers <= min(MOST_FINGERS, len(grasp.certificate.candidates)):
        raise GraspFileError(f"{grasp.search.fingers} fingers for {len(grasp.certificate.candidates)} candidates")
    if grasp.search.candidates != len(grasp.certificate.candidates):
        raise GraspFileError(
            f"{grasp.search.candidates} candidates are stated; the file holds {len(grasp.certificate.candidates)}"
        )
    kinds = grasp.certificate.kinds
    if kinds and sum(kind.fingers for kind in kinds) != grasp.search.fingers:
        raise GraspFileError(f"the kinds of fingers do not add up to {grasp.search.fingers} fingers")
    if grasp.search.subsets != grasp.certificate.subsets(grasp.search.fingers):
        raise GraspFileError(f"{grasp.search.subsets} subsets are stated; the candidates have another number")
    _check_trace(grasp.search)
    _check_proof_check(grasp.proof_check)
    center = grasp.center_of_mass
    if center is not None and center.shape != (grasp.certificate.candidates.dimension,):
        raise GraspFileError(f"the centre of mass has {center.size} coordinates, the candidates another number")
    if document.planner.version != document.planner.packages.get("rhograsp"):
        raise GraspFileError(f"made by version {document.planner.version}, with another among the packages: edited?")
    if not grasp.found:
        if document.rho is not None or len(grasp.phi):
            raise GraspFileError("rho and phi are given without contacts")
        return
    if len(grasp.contacts) != grasp.search.fingers or len(grasp.phi) != len(grasp.task.wrenches):
        raise GraspFileError(
            f"{len(grasp.contacts)} contacts for {grasp.search.fingers} fingers, "
            f"{len(grasp.phi)} values of phi for {len(grasp.task.wrenches)} wrenches"
        )
    if grasp.chosen.max() >= len(grasp.certificate.candidates) or len(set(grasp.chosen.tolist())) < len(grasp.chosen):
        raise GraspFileError(f"contacts name candidates {grasp.chosen.tolist()}, repeated or out of range")
    candidates = grasp.certificate.candidates
    _agree("position", grasp.contacts.points, candidates.points[grasp.chosen])
    _agree("normal", grasp.contacts.normals, candidates.normals[grasp.chosen])
    _agree("friction", grasp.contacts.friction, candidates.friction[grasp.chosen])
    _agree("torsion", grasp.contacts.torsions, candidates.torsions[grasp.chosen])
    _agree("strength", grasp.contacts.strengths, grasp.certificate.strengths[grasp.chosen])
    _agree("phi", grasp.phi, (np.linalg.norm(grasp.forces, axis=2) / grasp.contacts.strengths).max(axis=1))
    _agree("rho", np.array(document.rho, dtype=float), grasp.phi.max())
    gap = np.inf if document.gap is None else document.gap
    if gap != grasp.gap:  # both may be infinite, where no bound is proven
        _agree("gap", np.array(gap), np.array(grasp.gap))
    if grasp.torques[:, grasp.contacts.torsions == 0].any():
        raise GraspFileError("a torque is given at a contact without torsional friction: edited?")
    if document.critical_wrench != grasp.critical_wrench:
        raise GraspFileError(
            f"critical_wrench is {document.critical_wrench}; phi is largest at {grasp.critical_wrench}"
        )


def _check_trace(search: SearchRecord) -> None:
    """Raise GraspFileError unless the search log, where there is one, ends where the search did."""
    if not search.trace:
        return
    end = search.trace[-1]
    for name in ("seconds", "nodes", "socp_solves", "cuts"):
        logged, stated = getattr(end, name), getattr(search, name)
        if logged != stated:
            raise GraspFileError(f"the search log ends with {logged} {name}, the search with {stated}: edited?")


def _check_proof_check(check: ProofCheck | None) -> None:
    """Raise GraspFileError unless what was checked of the proof is a share of it."""
    if check is not None and not (0 <= check.share <= 1 and check.seconds >= 0):
        raise GraspFileError(f"a share of {check.share:g} of the proof was checked in {check.seconds:g} s: edited?")


def _agree(name: str, stated: Floats, derived: Floats) -> None:
    difference = np.abs(stated - derived).max()
    if not difference <= AGREEMENT * max(1.0 if name == "gap" else 0.0, float(np.abs(derived).max())):
        raise GraspFileError(f"{name} does not agree with the rest of the file (off by {difference:.3g}): edited?")
