"""Do the candidates lie on the object, with the normals, the friction and the geoms that are there?

Half-spaces for flat facets: a point p of the solid { x : n_k . x <= o_k for all k } with inward normal n lies on it if
n_k . p = o_k and n = -n_k for some k. Curved parts and outlines: p is its own projection on some facet.
"""

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.candidates.candidates import CandidateChoice
from planner.contact_models.soft_finger import torsion_of_patch
from planner.contacts import Contacts
from planner.grasps.grasp import Grasp
from planner.millimetres import in_mm, point_in_mm
from planner.objects.graspable import Graspable
from planner.objects.part import Part
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.planar.outline import Outline
from planner.objects.surface.exposure import exposed
from planner.objects.vectors import norm
from planner.verification.check import Check, checked, not_checked
from planner.verification.provenance.mass import NO_OBJECT

ON_SURFACE = 2e-6
"""Largest distance from the surface, relative to the object's size: corners lie half as far off their facet's plane."""

SAME_NORMAL = 1e-6
"""Largest angle to the normal of the surface [rad]."""

SAME_FRICTION = 1e-6
"""Relative accuracy of a coefficient."""

CHUNK = 2_000_000
"""Pairs of points and facets compared at once: bounds the memory."""


def check_surface(grasp: Grasp, rigid_object: Graspable | None) -> Check:
    """Every candidate is on the outer surface, with the inward normal there."""
    contacts = grasp.certificate.candidates
    claim = f"the {len(contacts)} candidates lie on the object's surface, each with the normal there"
    if rigid_object is None:
        return not_checked(claim, NO_OBJECT)
    off = np.flatnonzero(~_parts_at(rigid_object, contacts.points, contacts.normals).any(axis=0))
    if not len(off):
        return checked(claim, True, f"within {ON_SURFACE:g} of the object's size and {np.rad2deg(SAME_NORMAL):.1g}°")
    first = point_in_mm(contacts.points[off[0]])
    return checked(claim, False, f"{len(off)} do not, the first is candidate {off[0]} at {first} mm")


def check_friction(grasp: Grasp, rigid_object: Graspable | None) -> Check:
    """Every coefficient is the one that was given or the geom's own, less its error; so is torsional friction."""
    candidates, choice = grasp.certificate.candidates, grasp.candidate_choice
    if choice is None:
        return not_checked("the candidates have the friction of their geoms", "how they were chosen is not recorded")
    less = f", less {choice.friction_error:g} of it" if choice.friction_error else ""
    source = "that of their geoms" if choice.friction is None else f"{choice.friction:g}"
    twist = _twist(choice) if candidates.torsions.any() else ""
    claim = f"the candidates' friction is {source}{twist}{less}"
    share = 1 - choice.friction_error
    if choice.friction is not None:
        right = _same(candidates.friction, np.full(len(candidates), share * choice.friction))
    elif rigid_object is None:
        return not_checked(claim, NO_OBJECT)
    else:
        there = _parts_at(rigid_object, candidates.points, candidates.normals)
        own = np.array([part.friction for part in rigid_object.parts])
        alike = there & _same(candidates.friction, share * own[:, None])
        right = np.where(there.any(axis=0), alike.any(axis=0), True)
    given = _given_torsion(choice, candidates)
    if given is not None:
        right &= _same(candidates.torsions, given)
    return checked(claim, bool(right.all()), f"{len(right) - right.sum()} of {len(right)} have another")


def _twist(choice: CandidateChoice) -> str:
    """Where torsional friction comes from, in words."""
    if choice.limited:
        return ""  # limits may say it for each finger; whether they do is seen where the candidates are chosen again
    if choice.patch is not None:
        return f", torsional friction that of discs of {in_mm(choice.patch)} mm radius"
    return "" if choice.torsion is None else f", torsional friction {in_mm(choice.torsion)} mm"


def _given_torsion(choice: CandidateChoice, candidates: Contacts) -> Floats | None:
    """The torsional friction that was given, less its error, shape (n,) [m]; None where geoms or limits say it."""
    if choice.limited or (choice.torsion is None) == (choice.patch is None):
        return None
    if choice.torsion is not None:
        return np.full(len(candidates), (1 - choice.friction_error) * choice.torsion)
    return torsion_of_patch(choice.patch or 0.0, candidates.friction)


def check_geoms(grasp: Grasp, rigid_object: Graspable | None) -> Check:
    """Every contact is on the geom that is named."""
    claim = f"the contacts lie on {', '.join(dict.fromkeys(grasp.geoms))}"
    if rigid_object is None:
        return not_checked(claim, NO_OBJECT)
    there = _parts_at(rigid_object, grasp.contacts.points, grasp.contacts.normals)
    wrong = []
    for finger, geom in enumerate(grasp.geoms):
        found = {part.geom for part, here in zip(rigid_object.parts, there[:, finger], strict=True) if here}
        if geom not in found:
            wrong.append(f"contact {finger + 1} is named '{geom}' and lies on {', '.join(sorted(found)) or 'no geom'}")
    return checked(claim, not wrong, "; ".join(wrong) or "each on its own")


def _same(friction: Floats, expected: Floats) -> Mask:
    return np.abs(friction - expected) <= SAME_FRICTION * expected


def _parts_at(rigid_object: Graspable, points: Floats, normals: Floats) -> Mask:
    """On the outer surface of which parts, of those that fingers may touch, each point lies, shape (parts, n)."""
    tolerance = ON_SURFACE * rigid_object.size
    there = np.zeros((len(rigid_object.parts), len(points)), dtype=bool)
    for index in np.flatnonzero(rigid_object.touchable).tolist():
        part = rigid_object.parts[index]
        if isinstance(part, Polyhedron):
            on = _on_planes(part, points, normals, tolerance)
        else:
            on = _on_facets(part, points, normals, tolerance)
        here = np.flatnonzero(on)
        there[index, here] = exposed(rigid_object, points[here], normals[here], np.full(len(here), index))
    return there


def _on_planes(part: Polyhedron, points: Floats, normals: Floats, tolerance: float) -> Mask:
    """Whether each point lies on a polyhedron, on a facet with its normal, shape (n,)."""
    on, step = np.zeros(len(points), dtype=bool), max(1, CHUNK // len(part.offsets))
    for start in range(0, len(points), step):
        slack = part.offsets - points[start : start + step] @ part.outward_normals.T
        inside = (slack >= -tolerance).all(axis=1, keepdims=True)
        point, facet = np.nonzero(inside & (slack <= tolerance))
        same = norm(part.outward_normals[facet] + normals[start + point]) <= SAME_NORMAL
        on[start + point[same]] = True
    return on


def _on_facets(part: Part, points: Floats, normals: Floats, tolerance: float) -> Mask:
    """Whether each point is its own projection on some facet of a part, with its normal, shape (n,)."""
    on = np.zeros(len(points), dtype=bool)
    for facets in _facets_near(part, points, normals, tolerance):
        feet, there = part.project(points, facets)
        on |= (norm(points - feet) <= tolerance) & (norm(there - normals) <= SAME_NORMAL)
    return on


def _facets_near(part: Part, points: Floats, normals: Floats, tolerance: float) -> list[Indices]:
    """Facets that each point may lie on, each of shape (n,): all edges of an outline, else that under the point.

    On the edge of two facets, the one with the point's normal is under the point lifted along that normal.
    """
    if isinstance(part, Outline):
        return [np.full(len(points), edge) for edge in range(len(part.corners))]
    return [part.nearest_facet(points), part.nearest_facet(points - 10 * tolerance * normals)]
