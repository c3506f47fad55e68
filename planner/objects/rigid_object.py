"""A rigid object as MuJoCo collides it: a union of convex parts with mass properties.

Frame: the chosen MJCF body's frame B, SI.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from planner.objects.part import Part


class ConvexPart(Part, Protocol):
    """One collision geom: a convex solid whose surface is divided into facets."""

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """Triangles of the surface, shape (triangles, 3, 3) [m], and the facet of each, shape (triangles,).

        Exact for polyhedra; for curved parts a tessellation whose vertices lie on the surface.
        """


@dataclass(frozen=True, eq=False, kw_only=True)
class RigidObject:
    """One rigid object: what the planner plans on and the simulator collides with."""

    file: Path
    """The MJCF file it was read from."""

    sha256: str
    """Digest of that file and of every file it depends on."""

    body: str
    """Name of the body whose frame is B, or `body<id>` where it has none."""

    parts: tuple[ConvexPart, ...]
    """Collision geoms of the body and of its rigidly attached children."""

    mass: float
    """Mass of the subtree [kg]."""

    center_of_mass: np.ndarray
    """Shape (3,) [m]."""

    inertia: np.ndarray
    """Inertia tensor about the centre of mass in the axes of B, shape (3, 3) [kg m^2]."""

    extent: np.ndarray
    """Edge lengths of the collision surface's bounding box along the axes of B, shape (3,) [m]."""

    @property
    def size(self) -> float:
        """Diagonal of the bounding box [m]."""
        return float(np.linalg.norm(self.extent))
