"""The camera: from where the contacts are seen best, and so near that everything just fits."""

from dataclasses import dataclass, replace

import mujoco
import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from sim.render.sight import open_to

FIELD = 28.0
"""Vertical field of view [degrees]: a long lens, which distorts little."""
AZIMUTHS = tuple(quarter + turn for quarter in (0, 90, 180, 270) for turn in (28, 45, 62))
"""Three-quarter views [degrees]."""
LOWEST, HIGHEST = 28.0, 56.0
"""How far the camera looks down on objects that are tall, and flat [degrees]."""
PROBES = (0.02, 0.12, 0.25)
"""Distances from a contact, relative to the object's size, at which its arrow should be seen."""
MARGIN = 1.08
"""Room around what must be seen."""


@dataclass(frozen=True, eq=False, kw_only=True)
class View:
    """A camera that looks at a point."""

    azimuth: float
    """Direction of sight about the vertical [degrees]."""

    elevation: float
    """How far the direction of sight points down [degrees]."""

    target: Floats
    """Shape (3,) [m]."""

    distance: float
    """From the target [m]."""

    @property
    def axes(self) -> Floats:
        """Rows: to the right, up and towards the camera, shape (3, 3)."""
        azimuth, elevation = np.deg2rad([self.azimuth, self.elevation])
        right = np.array([np.sin(azimuth), -np.cos(azimuth), 0.0])
        back = np.array([-np.cos(azimuth) * np.cos(elevation), -np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
        return np.array([right, np.cross(back, right), back])

    def camera(self) -> mujoco.MjvCamera:
        """The same for MuJoCo."""
        camera = mujoco.MjvCamera()
        camera.azimuth, camera.elevation = self.azimuth, -self.elevation
        camera.lookat[:], camera.distance = self.target, self.distance
        return camera

    def pixels(self, points: Floats, width: int, height: int) -> Floats:
        """Where points, shape (n, 3) [m], are seen in a picture: columns and rows, shape (n, 2)."""
        right, up, back = self.axes @ (points - self.target).T
        scale = height / 2 / np.tan(np.deg2rad(FIELD) / 2) / (self.distance - back)
        return np.column_stack([width / 2 + scale * right, height / 2 - scale * up])

    def fitted(self, points: Floats, aspect: float) -> "View":
        """The same direction, with all points just in a picture of this width over height.

        A point seen at (x, y) across and z towards the camera is in the picture when |x| <= (distance - z) tan(half
        the field). The target moves until opposite edges have equal room.
        """
        right, up, back = self.axes @ points.T
        half = np.tan(np.deg2rad(FIELD) / 2) / MARGIN
        middle, distance = np.zeros(2), 0.0
        for _ in range(8):
            x, y = right - middle[0], up - middle[1]
            distance = float(np.max([back + np.abs(x) / (half * aspect), back + np.abs(y) / half]))
            across, down = x / (distance - back), y / (distance - back)
            depth = distance - float(back.mean())
            middle += 0.5 * depth * np.array([across.max() + across.min(), down.max() + down.min()])
        target = self.axes.T @ np.array([*middle, 0.0])
        return replace(self, target=target, distance=distance)


def best_direction(triangles: Floats, contacts: Contacts) -> tuple[float, float]:
    """Azimuth and elevation from which most of the contacts are seen, and their arrows from the side.

    Args:
        triangles: Of the object, shape (triangles, 3, 3) [m].
        contacts: In the same frame.
    """
    wide, deep, high = np.ptp(triangles.reshape(-1, 3), axis=0)
    elevation = LOWEST + (HIGHEST - LOWEST) * (1 - min(1.0, high / max(wide, deep)))
    size = float(np.linalg.norm([wide, deep, high]))
    probes = np.concatenate([contacts.points - reach * size * contacts.normals for reach in PROBES])

    def quality(azimuth: float) -> float:
        back = View(azimuth=azimuth, elevation=elevation, target=np.zeros(3), distance=1.0).axes[2]
        seen = open_to(triangles, probes, back).reshape(len(PROBES), -1).mean(axis=0)
        across = np.sqrt(1 - np.square(contacts.normals @ back).clip(0, 1))
        return float((seen * (0.6 + 0.4 * across)).mean())

    return max(AZIMUTHS, key=quality), elevation
