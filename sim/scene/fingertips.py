"""Fingertips: spheres that slide in every direction but do not turn, one at each contact.

The end effector of a grasp whose hand is not known. Another one needs what `EndEffector` asks, and its own coordinates
after those of the object.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import compress
from typing import Protocol

import numpy as np

from planner.arrays import Mask
from planner.contacts import Contacts
from sim.scene.dm_control_mjcf import mjcf
from sim.scene.physics import Physics

SENSOR = ("found", "force")
"""What the contact sensor of a finger reports: number of contacts, then the force in the contact frame."""

SENSOR_WIDTH = 4
"""Numbers per sensor."""


class EndEffector(Protocol):
    """What touches the object."""

    contacts: Contacts
    """Where it does, in the units of the scene, with the friction to simulate."""

    def attach(self, root: mjcf.RootElement, object_geoms: Sequence[mjcf.Element], physics: Physics) -> None:
        """Add it to a scene, a contact pair with every geom of the object, and a contact sensor for each finger."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Fingertips:
    """See `EndEffector`; the joints of finger i are its displacements from its anchor along x, y, z."""

    contacts: Contacts

    radius: float
    """[m]"""

    mass: float
    """Of each [kg]."""

    condim: int = 3
    """Dimensions of the contact space: 3, or 4 with torsional friction."""

    torsion: float = 0.0
    """Torsional friction [m]."""

    spared: Mask | None = None
    """Geoms of the object that a fingertip never touches, shape (contacts, geoms); None: it may touch all."""

    def attach(self, root: mjcf.RootElement, object_geoms: Sequence[mjcf.Element], physics: Physics) -> None:
        """See `EndEffector.attach`."""
        centers = self.contacts.points - self.radius * self.contacts.normals
        for finger, (center, friction) in enumerate(zip(centers, self.contacts.friction, strict=True)):
            body = root.worldbody.add("body", pos=center)
            for axis in np.eye(3):
                body.add("joint", type="slide", axis=axis)
            name, size = tip_name(finger), [self.radius]
            tip = body.add("geom", name=name, type="sphere", size=size, mass=self.mass, contype=0, conaffinity=0)
            for geom in self._met(finger, object_geoms):
                root.contact.add(
                    "pair",
                    geom1=tip,
                    geom2=geom,
                    condim=self.condim,
                    friction=[friction, friction, self.torsion, 0, 0],
                    solref=physics.solref,
                    solimp=physics.solimp,
                    margin=0,
                    gap=0,
                )
            root.sensor.add("contact", name=name, geom1=tip, data=" ".join(SENSOR), num=1, reduce="maxforce")

    def _met(self, finger: int, object_geoms: Sequence[mjcf.Element]) -> Iterator[mjcf.Element]:
        """The geoms that one fingertip may touch."""
        return iter(object_geoms) if self.spared is None else compress(object_geoms, ~self.spared[finger])


def tip_name(finger: int) -> str:
    """Name of a fingertip's geom, and of its sensor."""
    return f"tip_{finger}"
