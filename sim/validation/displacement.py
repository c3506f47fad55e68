"""A grasp with one contact moved along its facet: near the planned one, and not the same.

The contact p with inward normal n of a part's facet moves to the facet's nearest point to p + s t, t a tangent.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts, contact_frames
from planner.objects.rigid_object import RigidObject
from planner.objects.surface.exposure import exposed

LEAST_MOTION = 0.5
"""A contact that moved less than this part of the wanted distance met the edge of its facet."""
SAME_FACE = 0.99
"""Least cosine between the normals before and after: a contact that went round an edge is on another face."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DisplacedGrasp:
    """Contacts of which one has moved."""

    contacts: Contacts

    finger: int
    """The one that moved."""

    distance: float
    """How far [m]."""


def displaced_grasps(rigid_object: RigidObject, contacts: Contacts, distance: float) -> Iterator[DisplacedGrasp]:
    """All grasps in which one contact moved by about `distance` along one of its four tangents.

    Args:
        rigid_object: What is grasped.
        contacts: The grasp, in the body frame.
        distance: How far the contact should move [m].
    """
    frames = contact_frames(contacts.normals)
    for finger in range(len(contacts)):
        for tangent in (*frames[finger].T[1:], *-frames[finger].T[1:]):
            if rigid_object.in_plane and tangent[2]:
                continue  # a planar object is held in its plane
            moved = _moved(rigid_object, contacts, finger, distance * tangent)
            if moved is not None:
                yield moved


def _moved(rigid_object: RigidObject, contacts: Contacts, finger: int, step: Floats) -> DisplacedGrasp | None:
    """The grasp with one contact moved by about `step`; None where that leaves the face or the outer surface."""
    start = contacts.points[finger][None]
    feet = [part.project(start, part.nearest_facet(start))[0] for part in rigid_object.parts]
    index = int(np.argmin([np.linalg.norm(foot - start) for foot in feet]))
    part = rigid_object.parts[index]
    goal = start + step
    point, normal = part.project(goal, part.nearest_facet(goal))
    distance = float(np.linalg.norm(point - start))
    stays = distance > LEAST_MOTION * np.linalg.norm(step) and float(normal[0] @ contacts.normals[finger]) > SAME_FACE
    if not (stays and exposed(rigid_object, point, normal, np.array([index]))[0]):
        return None
    points, normals = contacts.points.copy(), contacts.normals.copy()
    points[finger], normals[finger] = point[0], normal[0]
    moved = replace(contacts, points=points, normals=normals)
    return DisplacedGrasp(contacts=moved, finger=finger, distance=distance)
