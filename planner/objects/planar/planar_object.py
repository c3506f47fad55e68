"""A rigid object in the plane: an outline with a mass.

Frame: the body frame B in which the outline is drawn, SI. Moments are numbers, positive counter-clockwise.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from planner.arrays import Floats, Mask
from planner.objects.object_source import ObjectSource
from planner.objects.part import Part
from planner.objects.planar.outline import Outline


@dataclass(frozen=True, eq=False, kw_only=True)
class PlanarObject:
    """What `RigidObject` is in space, with the same names for the same things."""

    file: Path
    """The file it was read from."""

    sha256: str
    """Digest of that file."""

    body: str
    """Its name."""

    outline: Outline

    mass: float
    """[kg]"""

    thickness: float
    """Height of the slab that stands for the object where a third dimension is needed [m]."""

    @property
    def source(self) -> ObjectSource:
        """The file it was read from; nothing else decides what comes out of it."""
        return ObjectSource(file=self.file, body=self.body)

    @property
    def gravity(self) -> None:
        """Its file states none."""

    @property
    def parts(self) -> tuple[Part, ...]:
        """The outline, the only part."""
        return (self.outline,)

    @property
    def torsions(self) -> Floats:
        """The plane has no normal to turn about, shape (1,)."""
        return np.zeros(1)

    @property
    def touchable(self) -> Mask:
        """Fingers may touch the outline, shape (1,)."""
        return np.ones(1, dtype=bool)

    @property
    def center_of_mass(self) -> Floats:
        """Of a uniform object: the centroid of its area, shape (2,) [m]."""
        return self.outline.centroid

    @property
    def extent(self) -> Floats:
        """Edge lengths of the outline's bounding box, shape (2,) [m]."""
        return np.ptp(self.outline.bounds(), axis=0)

    @property
    def size(self) -> float:
        """Diagonal of the bounding box [m]."""
        return float(np.linalg.norm(self.extent))
