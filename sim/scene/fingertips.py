"""Fingertips: spheres that slide in every direction but do not turn, one at each contact.

The end effector of a grasp whose hand is not known. Another one needs what `EndEffector` asks, and its own coordinates
after those of the object.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import compress
from typing import Protocol

import mujoco
import numpy as np

from planner.contact_models.models import model_of
from planner.contacts import Contacts
from planner.errors import SimulationError
from sim.scene.dm_control_mjcf import mjcf
from sim.scene.physics import Physics

SENSOR = ("found", "force", "torque")
"""What the contact sensor of a finger reports: number of contacts, then force and torque in the contact frame."""

SENSOR_WIDTH = 7
"""Numbers per sensor."""

FOUND, FORCE, TORQUE = 0, slice(1, 4), 4
"""Where they are: the number, the force (normal first), and the torque about the normal."""

LEAST_TORSION = mujoco.mjMINMU
"""MuJoCo raises friction below this to it [m]."""


class EndEffector(Protocol):
    """What touches the object."""

    contacts: Contacts
    """Where it does, in the units of the scene, with the friction and torsional friction to simulate."""

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

    spared: np.ndarray | None = None
    """Geoms of the object that a fingertip never touches, shape (contacts, geoms); None: it may touch all."""

    def attach(self, root: mjcf.RootElement, object_geoms: Sequence[mjcf.Element], physics: Physics) -> None:
        """See `EndEffector.attach`."""
        centers = self.contacts.points - self.radius * self.contacts.normals
        rubbing = zip(*pair_friction(self.contacts), strict=True)
        for finger, (center, (condim, friction)) in enumerate(zip(centers, rubbing, strict=True)):
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
                    condim=condim,
                    friction=friction,
                    solref=physics.solref,
                    solimp=physics.solimp,
                    margin=0,
                    gap=0,
                )
            root.sensor.add("contact", name=name, geom1=tip, data=" ".join(SENSOR), num=1, reduce="maxforce")

    def _met(self, finger: int, object_geoms: Sequence[mjcf.Element]) -> Iterator[mjcf.Element]:
        """The geoms that one fingertip may touch."""
        return iter(object_geoms) if self.spared is None else compress(object_geoms, ~self.spared[finger])


def pair_friction(contacts: Contacts) -> tuple[np.ndarray, np.ndarray]:
    """How MuJoCo takes the friction of each contact, each by its own model: condim, shape (contacts,), and the
    friction of its pair, shape (contacts, 5).

    A hard finger among soft ones keeps condim 3: with condim 4 MuJoCo would give it LEAST_TORSION.

    Args:
        contacts: In the units of the scene.

    Raises:
        SimulationError: When a torsional friction is too small for MuJoCo.
    """
    small = np.flatnonzero((contacts.torsions > 0) & (contacts.torsions < LEAST_TORSION))
    if small.size:
        raise SimulationError(
            f"the torsional friction of finger {small[0] + 1} is too small for MuJoCo, which has "
            f"{LEAST_TORSION:g} m or more where the farthest contact is {_farthest(contacts):.2g} m away, or none"
        )
    models = [model_of(contacts.subset(np.array([finger]))) for finger in range(len(contacts))]
    pairs = zip(models, contacts.friction.tolist(), contacts.torsions.tolist(), strict=True)
    return (
        np.array([model.condim for model in models]),
        np.array([model.pair_friction(friction, torsion) for model, friction, torsion in pairs]),
    )


def _farthest(contacts: Contacts) -> float:
    return float(np.linalg.norm(contacts.points, axis=1).max())


def tip_name(finger: int) -> str:
    """Name of a fingertip's geom, and of its sensor."""
    return f"tip_{finger}"
