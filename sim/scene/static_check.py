"""Before anything moves: does every fingertip touch the object where it was planned, and only there?

MuJoCo collides a mesh with its convex hull, so a contact planned inside a concave mesh is buried; a
fingertip in a corner narrower than itself touches two walls. Neither is a test of the grasp. The question is the one
that confirms candidates (planner/objects/mjcf/touch.py), so what the planner confirms is accepted here.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.millimetres import in_mm
from planner.objects.mjcf.touch import CLEARANCE, ON_SURFACE, SAME_NORMAL, TouchProbe, all_round
from sim.scene.scene import Scene

EQUAL = 1e-9
"""Differences of distances that mean nothing, relative to the object's size."""


@dataclass(frozen=True, eq=False, kw_only=True)
class StaticCheck:
    """Distances of the fingertips to the object in the planned pose, in the user's metres."""

    distances: Floats
    """Signed distance of each fingertip to the nearest part, shape (contacts,) [m]; negative inside."""

    touches: Indices
    """Number of surfaces each fingertip touches or will touch under load, shape (contacts,); parts that go on with the
    planned surface, as coincident and coplanar ones do, count as one with it."""

    turns: Floats
    """Angle between each planned normal and the nearest one of what is touched, shape (contacts,) [rad]."""

    spared: Mask
    """Parts that only go on with the surface each fingertip touches, shape (contacts, parts): the contact of the union
    is with one part, two would press twice."""

    tip_radius: float
    """Radius of the fingertips [m]."""

    tolerance: float
    """Largest |distance| of a fingertip that touches [m]."""

    def reasons(self) -> tuple[str, ...]:
        """One sentence per fingertip that is not where it should be."""
        sentences = []
        measured = zip(self.distances, self.touches, self.turns, strict=True)
        for finger, (distance, touches, turn) in enumerate(measured):
            if abs(distance) > self.tolerance:
                where = "inside" if distance < 0 else "off"
                sentences.append(
                    f"fingertip {finger + 1} is {in_mm(abs(distance), 2)} mm {where} the collision surface "
                    f"(allowed {in_mm(self.tolerance, 1)} mm): not planned on what MuJoCo collides, or a wall is too "
                    "near"
                )
            elif touches > 1:
                sentences.append(
                    f"fingertip {finger + 1} touches {touches} parts of the object at once even with a radius of "
                    f"{in_mm(self.tip_radius, 2)} mm: choose another contact"
                )
            elif turn > SAME_NORMAL:
                sentences.append(
                    f"fingertip {finger + 1} touches a surface whose normal is {np.rad2deg(turn):.2g}° from the "
                    f"planned one (allowed {np.rad2deg(SAME_NORMAL):.1g}°): choose another contact"
                )
        return tuple(sentences)


def check_touch(scene: Scene, size: float, length: float) -> StaticCheck:
    """Measure all fingertips in the planned pose.

    Args:
        scene: The compiled scene.
        size: Diagonal of the object's bounding box [m].
        length: Metres of the experiment per metre.
    """
    points, normals = scene.contacts.points, scene.contacts.normals
    probe = TouchProbe(scene.model, scene.tip_geoms[0], scene.object_geoms, size * length)
    touch = probe.touch(points, normals, scene.tip_radius)
    touched = touch.flush & touch.on_surface & touch.aligned
    planned = np.where(touched, _drop_off(probe, scene), np.inf).argmin(axis=1)
    return StaticCheck(
        distances=touch.gaps.min(axis=1) / length,
        touches=touch.walls.sum(axis=1) + touch.flush.any(axis=1),
        turns=np.where(touch.near, touch.turns, np.pi).min(axis=1),
        spared=touch.flush & (np.arange(len(scene.object_geoms)) != planned[:, None]),
        tip_radius=scene.tip_radius / length,
        tolerance=float(ON_SURFACE * size),
    )


def _drop_off(probe: TouchProbe, scene: Scene) -> Floats:
    """How far each part falls off around each contact, shape (contacts, parts); least for the one that goes on.

    The fingertips are put aside by the clearance, all round; rounded so that equal parts are equal.
    """
    points, normals = scene.contacts.points, scene.contacts.normals
    steps = all_round(normals, CLEARANCE * probe.size)
    gaps = [probe.touch(points + step, normals, scene.tip_radius).gaps for step in steps]
    return np.round(np.max(gaps, axis=0) / (EQUAL * probe.size))
