"""What a report shows, as plain values for one JSON document. Body frame, SI."""

import base64
import shlex
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from planner.arrays import Floats
from planner.files.json_document import finite_or_none
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import ConvexPart, RigidObject
from planner.pictures.shaded_surface import shaded_surface
from planner.pictures.sharp_edges import sharp_edges
from planner.search.result import Status
from planner.verification.why_infeasible import hopeless_cut, reasons, remedies

TIP_RADIUS = 0.02
"""Radius of a drawn fingertip where no validation states it, relative to the object's size."""


def report_data(
    rigid_object: RigidObject, grasp: Grasp, file: str, validation: Mapping[str, Any] | None
) -> dict[str, Any]:
    """Everything the page needs.

    Args:
        rigid_object: The object, in space.
        grasp: Its grasp, in space; or a search that has found none.
        file: Name of the grasp file.
        validation: The validation file's document as plain values, where there is one.
    """
    task, candidates = grasp.task, grasp.certificate.candidates
    corners = np.concatenate([part.triangles()[0].reshape(-1, 3) for part in rigid_object.parts])
    return {
        "file": file,
        "object": {
            "file": grasp.file.name,
            "body": grasp.body,
            "mass": grasp.mass,
            "extent": rigid_object.extent.tolist(),
            "sha256": grasp.sha256,
        },
        "size": rigid_object.size,
        "center": (0.5 * (corners.min(axis=0) + corners.max(axis=0))).tolist(),
        "mesh": _packed(np.concatenate([shaded_surface(part) for part in rigid_object.parts])),
        "edges": _packed(np.concatenate([_edges(part) for part in rigid_object.parts])),
        "tip_radius": validation["static"]["tip_radius"] if validation else TIP_RADIUS * rigid_object.size,
        "contacts": _contacts(grasp),
        "candidates": _packed(np.hstack([candidates.points, -candidates.normals])),
        "task": task.name,
        "reference_point": task.reference_point.tolist(),
        "wrenches": task.wrenches.tolist(),
        "phi": grasp.phi.tolist(),
        "forces": grasp.forces.tolist(),
        "torques": grasp.torques.tolist(),
        "rho": finite_or_none(grasp.rho),
        "grip": finite_or_none(grasp.grip),
        "lower_bound": grasp.lower_bound,
        "gap": finite_or_none(grasp.gap),
        "status": plain_status(grasp),
        "proof": {
            "cuts": len(grasp.certificate.cuts),
            "hopeless_wrench": hopeless_wrench(grasp),
            "reasons": reasons(grasp) if grasp.status is Status.INFEASIBLE else [],
            "remedies": remedies(grasp) if grasp.status is Status.INFEASIBLE else [],
        },
        "search": asdict(grasp.search),
        "candidate_choice": None if grasp.candidate_choice is None else asdict(grasp.candidate_choice),
        "command": grasp.command,
        "packages": grasp.packages,
        "commands": {name: f"grasp-{name} {shlex.quote(file)}" for name in ("verify", "validate", "report")},
        "validation": validation,
    }


def plain_status(grasp: Grasp) -> str:
    """How the search ended, in words."""
    return grasp.status.value.replace("_", " ")


def hopeless_wrench(grasp: Grasp) -> int | None:
    """The wrench that no candidates can balance, where a single cut proves that: the one that asks most along it."""
    cut = hopeless_cut(grasp)
    return None if cut is None else int((-grasp.task.wrenches @ cut).argmax())


def _contacts(grasp: Grasp) -> list[dict[str, Any]]:
    contacts = grasp.contacts
    arrays = (contacts.points, contacts.normals, contacts.friction, contacts.torsions, contacts.strengths)
    columns = (*(array.tolist() for array in arrays), grasp.geoms)
    names = ("position", "normal", "friction", "torsion", "strength", "geom")
    return [dict(zip(names, values, strict=True)) for values in zip(*columns, strict=True)]


def _edges(part: ConvexPart) -> Floats:
    """Ends of a part's visible edges, with a normal that does not matter, shape (2 edges, 6)."""
    ends = sharp_edges(part.triangles()[0]).reshape(-1, 3)
    return np.hstack([ends, np.tile([0.0, 0.0, 1.0], (len(ends), 1))])


def _packed(vertices: Floats) -> str:
    """Single precision, little endian, base 64: what the page hands to the graphics card."""
    return base64.b64encode(vertices.astype("<f4").tobytes()).decode()
