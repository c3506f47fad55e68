"""A rigid object as MuJoCo collides it: a union of convex parts with mass properties.

Frame: the chosen MJCF body's frame B, SI.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np


class ConvexPart(Protocol):
    """One collision geom: a convex solid whose surface is divided into facets."""

    @property
    def geom(self) -> str:
        """The geom's name in the compiled model, or `geom<id>` where it has none."""

    @property
    def friction(self) -> float:
        """Sliding friction coefficient the geom carries."""

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """Triangles of the surface, shape (triangles, 3, 3) [m], and the facet of each, shape (triangles,).

        Exact for polyhedra; for curved parts a tessellation whose vertices lie on the surface.
        """

    def bounds(self) -> np.ndarray:
        """Lower and upper corner of the part's bounding box along the axes of B, shape (2, 3) [m]."""

    def nearest_facet(self, points: np.ndarray) -> np.ndarray:
        """The facet nearest to each point that lies on or near the surface, shape (n,)."""

    def project(self, points: np.ndarray, facets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Nearest points of the given facets' exact surface and the inward unit normals there.

        Args:
            points: Points near their facets, shape (n, 3) [m].
            facets: Facet of each point, shape (n,).

        Returns:
            Surface points and inward unit normals, each of shape (n, 3).
        """

    def depth(self, points: np.ndarray) -> np.ndarray:
        """How deep each point lies inside: positive inside, zero on the surface, negative outside [m].

        The sign is exact; the magnitude is a lower bound of the distance to the surface for points inside.
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
