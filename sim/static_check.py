"""Before anything moves: does every fingertip touch the object where it was planned, and only there?

MuJoCo collides a mesh with its convex hull, so a contact planned inside a concave mesh is buried; a
fingertip in a corner narrower than itself touches two walls. Neither is a test of the grasp.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from planner.millimetres import in_mm
from sim.protocol import ValidationProtocol
from sim.scene import Scene


@dataclass(frozen=True, eq=False, kw_only=True)
class StaticCheck:
    """Distances of the fingertips to the object in the planned pose, in the user's metres."""

    distances: np.ndarray
    """Signed distance of each fingertip to the nearest part, shape (contacts,) [m]; negative inside."""

    touches: np.ndarray
    """Number of parts each fingertip touches or will touch under load, shape (contacts,)."""

    tip_radius: float
    """Radius of the fingertips [m]."""

    tolerance: float
    """Largest |distance| of a fingertip that touches [m]."""

    def reasons(self) -> tuple[str, ...]:
        """One sentence per fingertip that is not where it should be."""
        sentences = []
        for finger, (distance, touches) in enumerate(zip(self.distances, self.touches, strict=True)):
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
        return tuple(sentences)


def check_touch(scene: Scene, size: float, length: float, protocol: ValidationProtocol) -> StaticCheck:
    """Measure all fingertips in the planned pose.

    Args:
        scene: The compiled scene.
        size: Diagonal of the object's bounding box [m].
        length: Metres of the experiment per metre.
        protocol: Tolerances.
    """
    model = scene.model
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    far = protocol.reach + size * length
    distances = np.array(
        [
            [mujoco.mj_geomDistance(model, data, tip, part, far, None) for part in scene.object_geoms]
            for tip in scene.tip_geoms
        ]
    )
    return StaticCheck(
        distances=distances.min(axis=1) / length,
        touches=(distances < protocol.clearance * protocol.reach).sum(axis=1),
        tip_radius=scene.tip_radius / length,
        tolerance=float(protocol.touch_tolerance * size),
    )
