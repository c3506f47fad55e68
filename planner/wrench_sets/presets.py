"""Required external force sets whose sizes come from the object: usable by name alone.

To add one: write its class here, with the method of `Preset`, and name it in `PRESETS`.
"""

from typing import Protocol

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension
from planner.errors import TaskError
from planner.objects.graspable import Graspable
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.surface.nearest import surface_distance
from planner.wrench_sets.box import WrenchBox
from planner.wrench_sets.cylinder import WrenchCylinder
from planner.wrench_sets.polytope import WrenchPolytope
from planner.wrench_sets.values import size
from planner.wrench_sets.wrench_set import WrenchSet

GRAVITY = 9.81
"""Standard weight per mass [m/s^2]."""


class Preset(Protocol):
    """A family of wrench sets with one member per object."""

    def for_object(self, object: Graspable, reference_point: Floats) -> WrenchSet:
        """The set for one object.

        Args:
            object: The object.
            reference_point: p_o, about which moments are taken, shape (d,) [m].

        Raises:
            TaskError: When the object has no mass.
        """


class Paper(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """In space W_R = { (f, m) : |f_k| <= W, |m_k| <= 0.8 γ W }, in the plane { (f, m) : |f| <= W, |m| <= 0.8 γ W }.

    W is the weight: weight in any direction, its centre anywhere within 0.8 γ of the reference point. γ is the
    distance from there to the nearest facet in space, to the nearest corner in the plane. The planar set is
    circumscribed by a prism of 8 sides and 2 caps. Source: Watanabe and Yoshikawa, section 4, Cases III, I and II.
    """

    def for_object(self, object: Graspable, reference_point: Floats) -> WrenchSet:
        """See `Preset`."""
        force = weight(object)
        if isinstance(object, PlanarObject):
            moment = 0.8 * object.outline.corner_distance(reference_point) * force
            return WrenchCylinder(force=force, moment=moment, dimension=2)
        moment = 0.8 * surface_distance(object, reference_point) * force
        return WrenchBox(force=(force, force, force), moment=(moment, moment, moment))


class Gravity(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = { (f, m) : |f| <= W, |m| <= W radius }.

    It contains conv { (f, r x f) : |f| = W, |r| <= radius }, the weight W in every direction with its centre
    anywhere within `radius` of the reference point, because |r x f| <= |r| |f|.

    Raises:
        TaskError: When the radius is negative or not finite.
    """

    radius: float | None = None
    """How far the centre of mass may be from the reference point [m]; a tenth of the object's shortest
    extent where left out."""

    def __post_init__(self) -> None:
        if self.radius is not None:
            size("radius", self.radius, zero=True)

    def for_object(self, object: Graspable, reference_point: Floats) -> WrenchSet:
        """See `Preset`."""
        radius = 0.1 * float(object.extent.min()) if self.radius is None else self.radius
        return WrenchCylinder(force=weight(object), moment=weight(object) * radius, dimension=len(reference_point))


class Axes6(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """W_R = conv { (±a M e_k, 0) : k = 1, ..., d }: the mass M pushed along each axis, without moment.

    Six pushes in space, four in the plane.

    Raises:
        TaskError: When the acceleration is not positive and finite.
    """

    acceleration: float = 10.0
    """a [m/s^2]."""

    def __post_init__(self) -> None:
        size("acceleration", self.acceleration, zero=False)

    def for_object(self, object: Graspable, reference_point: Floats) -> WrenchSet:
        """See `Preset`."""
        push = weight(object) / GRAVITY * self.acceleration
        dimension = len(reference_point)
        axes = push * np.eye(dimension, wrench_dimension(dimension))
        wrenches = np.vstack([axes, -axes])
        return WrenchPolytope(wrenches=tuple(map(tuple, wrenches.tolist())))


def weight(object: Graspable) -> float:
    """Weight of the object [N].

    Raises:
        TaskError: When it has none.
    """
    if not (np.isfinite(object.mass) and object.mass > 0):
        raise TaskError(
            f"the object has no mass: {object.mass} kg in {object.file}; give it one, or choose a task file "
            "whose set states its forces itself"
        )
    return float(object.mass * GRAVITY)


PRESETS: dict[str, type[Preset]] = {"paper": Paper, "gravity": Gravity, "axes6": Axes6}
