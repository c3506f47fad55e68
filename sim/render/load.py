"""The wrench that pushes on the object, drawn where it is seen: a force as an arrow, a moment as an arc.

Both act at the reference point, inside the object. A force has the same effect anywhere on its line of action, so its
arrow stands where that line leaves the object on the camera's side; it points away from the object there, or at it.
The arc of a moment stands where the moment's axis leaves the object. The arrow has the scale of the finger forces.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from sim.render.annotations import Annotations
from sim.render.palette import LOAD
from sim.render.proportions import ARC_ROD, ARROW, SHAFT
from sim.render.sight import exit_distance

GAP = 0.02
"""Between the object and the arrow, relative to the object's size."""
TURN = 0.11
"""Radius of the arc of a moment, relative to the object's size."""
TURN_GAP = 0.1
"""Between the object and the arc, relative to the object's size."""
TURN_ROOM = 1.3
"""Radius of the arc with its head, relative to the arc's."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Load:
    """A wrench about the origin and where it is drawn, in world axes."""

    force: Floats
    """As an arrow, shape (3,) [m]."""

    tip: Floats
    """End of the arrow of the full force, shape (3,) [m]."""

    moment: Floats
    """Shape (3,) [N m]."""

    center: Floats
    """Of the arc, shape (3,) [m]."""

    size: float
    """Of the object [m]."""

    def draw(self, annotations: Annotations, shift: Floats, share: float) -> None:
        """Draw a part of the load on an object that has moved by `shift`, shape (3,) [m]."""
        if not share > 0:
            return
        if self.force.any():
            annotations.arrow(self.tip_at(share) + shift, share * self.force, SHAFT * self.size, LOAD)
        if self.moment.any():
            axis = self.moment / np.linalg.norm(self.moment)
            annotations.turn(self.center + shift, axis, share, TURN * self.size, ARC_ROD * self.size, LOAD)

    def points(self) -> Floats:
        """What must be in the picture, shape (n, 3) [m]."""
        arrow = [self.tip, self.tip - self.force] if self.force.any() else []
        reach = TURN_ROOM * TURN * self.size
        arc = [self.center + step for step in reach * np.vstack([np.eye(3), -np.eye(3)])] if self.moment.any() else []
        return np.array([*arrow, *arc]).reshape(-1, 3)

    def tip_at(self, share: float) -> Floats:
        """End of the arrow of a part of the force, shape (3,) [m].

        An arrow that points away grows from its foot, one that points at the object from its tip.
        """
        away = self.force @ self.tip >= 0
        return self.tip - (1 - share) * self.force if away else self.tip


def placed_load(wrench: Floats, triangles: Floats, back: Floats, size: float) -> Load:
    """Where a wrench is drawn.

    Args:
        wrench: About the origin, forces relative to rho, shape (6,).
        triangles: Of the object, shape (triangles, 3, 3) [m].
        back: Unit vector from the object to the camera, shape (3,).
        size: Of the object [m].
    """
    force, moment = np.split(wrench, 2)
    arrow = ARROW * size * force
    foot, away = _on_camera_side(force, triangles, back, GAP * size)
    center, _ = _on_camera_side(moment, triangles, back, TURN_GAP * size)
    return Load(force=arrow, tip=foot + arrow if away else foot, moment=moment, center=center, size=size)


def _on_camera_side(vector: Floats, triangles: Floats, back: Floats, gap: float) -> tuple[Floats, bool]:
    """A little beyond where a vector's line through the origin leaves the object on the camera's side, shape (3,) [m];
    and whether the vector points away from the object there."""
    length = float(np.linalg.norm(vector))
    if not length > 0:
        return np.zeros(3), True
    away = bool(vector @ back >= 0)
    side = vector / length if away else -vector / length
    return (exit_distance(triangles, np.zeros(3), side) + gap) * side, away
