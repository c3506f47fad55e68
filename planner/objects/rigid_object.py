"""A rigid object as MuJoCo collides it: a union of convex parts with mass properties.

Frame: the chosen MJCF body's frame B, SI.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.objects.given_mass import GivenMass
from planner.objects.object_source import ObjectSource
from planner.objects.part import Part
from planner.objects.pose import Pose


class ConvexPart(Part, Protocol):
    """One collision geom: a convex solid whose surface is divided into facets."""

    @property
    def mjcf_type(self) -> str:
        """MuJoCo's name for this kind of geom."""

    def triangles(self) -> tuple[Floats, Indices]:
        """Triangles of the surface, shape (triangles, 3, 3) [m], and the facet of each, shape (triangles,).

        Exact for polyhedra; for curved parts a tessellation whose vertices lie on the surface.
        """


@dataclass(frozen=True, eq=False, kw_only=True)
class RigidObject:
    """One rigid object: what the planner plans on and the simulator collides with."""

    source: ObjectSource
    """The MJCF file it was read from, and how; its body is the one below."""

    sha256: str
    """Digest of that file and of every file it depends on."""

    body: str
    """Name of the body whose frame is B, or `body<id>` where it has none."""

    parts: tuple[ConvexPart, ...]
    """Collision geoms of the body and of its rigidly attached children."""

    mass: float
    """Mass of the subtree [kg]."""

    center_of_mass: Floats
    """Shape (3,) [m]."""

    inertia: Floats
    """Inertia tensor about the centre of mass in the axes of B, shape (3, 3) [kg m^2]."""

    extent: Floats
    """Edge lengths of the collision surface's bounding box along the axes of B, shape (3,) [m]."""

    pose_in_file: Pose = field(default_factory=Pose.identity)
    """X_WB: where the file places the body in its world W, at qpos0 or the keyframe."""

    gravity: float | None = None
    """Magnitude of the file's own `option gravity` [m/s^2]; None for objects that no file describes."""

    torsion: tuple[float, ...] = ()
    """See `torsions`; empty where the file gives no part any."""

    untouchable: frozenset[int] = frozenset()
    """Parts, by number, that no finger may touch, because they are not of the body that the user asked for."""

    @property
    def file(self) -> Path:
        """The MJCF file it was read from."""
        return self.source.file

    @property
    def given(self) -> GivenMass:
        """What of the mass properties the user gave in place of the file's."""
        return self.source.given

    @property
    def torsions(self) -> Floats:
        """Torsional friction of each part's geom, 0 where its condim has none, shape (parts,) [m]."""
        return np.array(self.torsion or np.zeros(len(self.parts)))

    @property
    def touchable(self) -> Mask:
        """Whether fingers may touch each part, shape (parts,)."""
        return ~np.isin(np.arange(len(self.parts)), list(self.untouchable))

    @property
    def in_plane(self) -> bool:
        """Whether it moves in the plane z = 0 only, as the slab of a planar object does."""
        return False

    @property
    def size(self) -> float:
        """Diagonal of the bounding box [m]."""
        return float(np.linalg.norm(self.extent))

    def weighing(self, given: GivenMass) -> "RigidObject":
        """The same object with the given mass properties; the inertia grows with the mass."""
        mass = self.mass if given.mass is None else given.mass
        center = self.center_of_mass if given.center_of_mass is None else given.center_of_mass
        inertia = self.inertia * (mass / self.mass) if self.mass > 0 else self.inertia
        source = replace(self.source, given=given)
        return replace(self, source=source, mass=mass, center_of_mass=center, inertia=inertia)
