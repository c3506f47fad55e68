"""Mass properties that the user gives in place of those of the object's file."""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from planner.errors import ObjectError


@dataclass(frozen=True, eq=False, kw_only=True)
class GivenMass:
    """What is given; None keeps what the file says. It travels in the grasp file, so that nothing is hidden.

    Raises:
        ObjectError: On a mass that is not positive and finite, or a centre of mass that is not finite.
    """

    mass: float | None = None
    """[kg]"""

    center_of_mass: Floats | None = None
    """In the body frame B, shape (3,) [m]."""

    def __post_init__(self) -> None:
        if self.mass is not None and not (np.isfinite(self.mass) and self.mass > 0):
            raise ObjectError(f"the given mass is {self.mass} kg; it must be positive and finite")
        center = self.center_of_mass
        if center is not None and (center.shape != (3,) or not np.isfinite(center).all()):
            raise ObjectError(f"the given centre of mass is {center}; it must be three finite numbers, in metres")

    @property
    def nothing(self) -> bool:
        """Whether the file's values stand."""
        return self.mass is None and self.center_of_mass is None


NOTHING_GIVEN = GivenMass()
"""The file's values stand."""


def given_mass(mass: float | None, center_of_mass: tuple[float, ...] | None) -> GivenMass:
    """From what the user typed: a mass [kg] and a point of the body frame [m], either of them or none.

    Raises:
        ObjectError: If they are out of range.
    """
    return GivenMass(mass=mass, center_of_mass=None if center_of_mass is None else np.array(center_of_mass, float))
