"""Is a grasp file true? Checked with none of the code that searched for it.

What it says of its object is checked by making it again (`planner.provenance`), forces by the definition of balance,
cone and cap, rho by an independent CVXPY model of every inner problem, and the bound by the cuts of the certificate
(`planner.verification.bound_check`).
"""

from itertools import combinations
from pathlib import Path
from time import perf_counter

import numpy as np

from planner.counted import counted
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.grasps.grasp import Grasp
from planner.millimetres import in_mm
from planner.progress import Observe
from planner.search.result import Status
from planner.verification.bound_check import Claim, check_bound
from planner.verification.check import Check, checked
from planner.verification.provenance.provenance import check_provenance

TOLERANCE = 1e-6
"""Relative accuracy asked of forces and of rho."""

INFEASIBLE_TIMES = 1e4
"""A grasp that needs this many times the largest wrench of W_R is called infeasible."""


def verify(grasp: Grasp, observe: Observe = lambda *_: None, moved: Path | None = None) -> tuple[Check, ...]:
    """Check every claim of a grasp.

    Args:
        grasp: What to check.
        observe: Told the progress of what may take long.
        moved: Where the object's file is now; by default where the grasp says.

    Returns:
        One check per claim; nothing in the grasp is false if none fails, and it is true if all hold. Claims that could
        not be checked, about an object whose file is absent for example, say why.
    """
    checks = list(check_provenance(grasp, moved))
    if grasp.found:
        checks += [_contacts(grasp), _balance(grasp), _cones(grasp), _caps(grasp), _rho(grasp, observe)]
    return (*checks, _bound(grasp, observe), _status(grasp))


def _contacts(grasp: Grasp) -> Check:
    candidates = grasp.certificate.candidates
    contacts = candidates.subset(grasp.chosen)
    difference = max(
        float(np.abs(grasp.contacts.points - contacts.points).max()) / float(np.abs(candidates.points).max() or 1.0),
        float(np.abs(grasp.contacts.normals - contacts.normals).max()),
        float(np.abs(grasp.contacts.friction - contacts.friction).max()),
        float(np.abs(grasp.contacts.torsions - contacts.torsions).max()) / float(contacts.torsions.max() or 1.0),
        float(np.abs(grasp.contacts.strengths / grasp.certificate.strengths[grasp.chosen] - 1).max()),
    )
    broken = _broken_limits(grasp)
    return checked(
        claim="the contacts are candidates that keep the limits" if _limited(grasp) else "the contacts are candidates",
        holds=difference <= TOLERANCE and not broken,
        detail="; ".join([f"largest difference {difference:.1e}", *broken]),
    )


def _limited(grasp: Grasp) -> bool:
    certificate = grasp.certificate
    return bool(certificate.kinds) or certificate.spacing > 0 or certificate.span < np.inf


def _broken_limits(grasp: Grasp) -> list[str]:
    """What the chosen candidates do not keep: as many of each kind as it has fingers, spacing and span."""
    certificate, chosen = grasp.certificate, grasp.chosen
    broken = []
    for number, kind in enumerate(certificate.kinds):
        count = int((certificate.kind[chosen] == number).sum())
        if count != kind.fingers:
            broken.append(f"{count} contacts for the {kind.fingers} fingers of kind {number + 1}")
    for first, second in combinations(range(len(chosen)), 2):
        points = certificate.candidates.points[chosen]
        distance = float(np.linalg.norm(points[first] - points[second]))
        if not certificate.spacing <= distance <= certificate.span:
            broken.append(f"contacts {first + 1} and {second + 1} are {in_mm(distance, 6)} mm apart")
    return broken


def _balance(grasp: Grasp) -> Check:
    """sum f = -force and sum (p - p_o) x f + tau n = -moment for every wrench."""
    task, dimension = grasp.task, grasp.contacts.dimension
    arms = grasp.contacts.points - task.reference_point
    force = grasp.forces.sum(axis=1) + task.wrenches[:, :dimension]
    if dimension == 2:
        moments = arms[:, 0] * grasp.forces[..., 1] - arms[:, 1] * grasp.forces[..., 0]
        moment = moments.sum(axis=1)[:, None] + task.wrenches[:, 2:]
    else:
        moment = np.cross(arms, grasp.forces).sum(axis=1) + grasp.torques @ grasp.contacts.normals
        moment += task.wrenches[:, 3:]
    length = float(np.linalg.norm(arms, axis=1).max()) or 1.0
    error = max(float(np.abs(force).max()), float(np.abs(moment).max()) / length) / grasp.rho
    return checked(
        claim="the forces balance every wrench", holds=error <= TOLERANCE, detail=f"residual {error:.1e} of rho"
    )


def _cones(grasp: Grasp) -> Check:
    """Angle of every force to its normal at most atan(mu), less where the finger twists; hard ones do not twist."""
    contacts = grasp.contacts
    normal = np.einsum("jid,id->ji", grasp.forces, contacts.normals)
    length = np.linalg.norm(grasp.forces, axis=2)
    tangential = np.sqrt(np.maximum(length**2 - normal**2, 0.0))
    soft = contacts.torsions > 0
    rub = np.sqrt(tangential**2 + (grasp.torques * contacts.friction / np.where(soft, contacts.torsions, 1.0)) ** 2)
    outside = float(np.maximum(rub - contacts.friction * normal, -normal).max()) / grasp.rho
    return checked(
        claim="every force lies in its friction cone",
        holds=outside <= TOLERANCE and not grasp.torques[:, ~soft].any(),
        detail=f"largest excess {max(outside, 0.0):.1e} of rho",
    )


def _caps(grasp: Grasp) -> Check:
    """|f_i| <= s_i phi for every wrench, and phi <= rho."""
    lengths = np.linalg.norm(grasp.forces, axis=2) / grasp.contacts.strengths
    excess = float((lengths - grasp.phi[:, None]).max()) / grasp.rho
    return checked(
        claim="no finger pushes harder than it has to be able to",
        holds=excess <= TOLERANCE,
        detail=f"largest excess {max(excess, 0.0):.1e} of rho",
    )


def _rho(grasp: Grasp, observe: Observe) -> Check:
    """rho is the largest phi, each from an independent model."""
    contacts = grasp.contacts
    solver = ReferenceForces(len(contacts), contacts.dimension, twisting=bool(contacts.torsions.any()))
    task, phi = grasp.task, np.empty(len(grasp.task.wrenches))
    for row, wrench in enumerate(task.wrenches):
        observe("wrenches solved by an independent solver", row, len(phi))
        problem = ForceProblem(contacts=contacts, reference_point=task.reference_point, wrench=wrench)
        phi[row] = solver.solve(problem).phi
    difference = float(np.abs(phi - grasp.phi).max()) / grasp.rho
    return checked(
        claim="an independent solver finds the same forces for every wrench",
        holds=difference <= TOLERANCE and abs(float(phi.max()) / grasp.rho - 1) <= TOLERANCE,
        detail=f"rho {phi.max():.9g} N, phi differs by at most {difference:.1e} of rho",
    )


def _bound(grasp: Grasp, observe: Observe) -> Check:
    """The cuts prove the lower bound for every subset."""
    search, certificate = grasp.search, grasp.certificate
    claim = f"no {search.fingers} of {len(certificate.candidates)} candidates need less than {grasp.lower_bound:.6g} N"
    if grasp.lower_bound <= 0:
        return checked(claim=claim, holds=True, detail="no bound is claimed")
    task = grasp.task
    subsets = certificate.subsets(search.fingers)

    def settled(count: float) -> None:
        observe("subsets bounded by the cuts", count, subsets)

    settled(0)
    began = perf_counter()
    check = check_bound(
        certificate, Claim(search.fingers, task.reference_point, task.wrenches, grasp.lower_bound), settled
    )
    covered = f"{counted(len(certificate.cuts), 'cut')}, {counted(subsets, 'subset')}"
    detail = f"{covered}, by {check.method} in {perf_counter() - began:.2g} s"
    if check.counterexample:
        detail += f"; no cut covers subset {check.counterexample}"
    return checked(claim=claim, holds=check.proven, detail=detail)


def _status(grasp: Grasp) -> Check:
    """The status says no more than the bound does."""
    claim = f"the status is {grasp.status}"
    if grasp.status is Status.OPTIMAL:
        asked = max(grasp.search.gap, TOLERANCE)
        return checked(
            claim=claim, holds=grasp.found and grasp.gap <= asked, detail=f"gap {grasp.gap:.3g}, asked {asked:.3g}"
        )
    if grasp.status is Status.INFEASIBLE:
        arms = grasp.certificate.candidates.points - grasp.task.reference_point
        dimension = arms.shape[1]
        forces, moments = np.split(grasp.task.wrenches, [dimension], axis=1)
        load = max(float(np.abs(forces).max()), float(np.abs(moments).max() / np.linalg.norm(arms, axis=1).max()))
        times = grasp.lower_bound / load
        return checked(
            claim=claim,
            holds=not grasp.found and times >= INFEASIBLE_TIMES * (1 - TOLERANCE),
            detail=f"any grasp needs at least {times:.3g} times the largest wrench",
        )
    return checked(claim=claim, holds=True, detail=f"gap {grasp.gap:.3g} is open and so stated")
