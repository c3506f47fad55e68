"""What is measured: a grasp in space and the loads on it, with what theory says that each of them needs."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from planner.arrays import Floats, Mask
from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.grasps.grasp import Grasp
from planner.grasps.lift import in_space
from planner.objects.graspable import Graspable
from planner.objects.rigid_object import RigidObject
from sim.trial.prediction import on_friction_limit, predicted_caps


@dataclass(frozen=True, eq=False, kw_only=True)
class LoadedGrasp:
    """An object, the contacts that hold it, and the wrenches that they must resist.

    Raises:
        SimulationError: When shapes differ from (l, 6) and (l,), or a wrench is not finite.
    """

    rigid_object: RigidObject
    """What the fingers hold."""

    contacts: Contacts
    """In the body frame, SI, with the planned friction and the fingers' strengths."""

    reference_point: Floats
    """p_o, shape (3,) [m]."""

    wrenches: Floats
    """Vertices of W_R about p_o, shape (wrenches, 6) [N, N m]."""

    phi: Floats
    """Predicted cap of every wrench, shape (wrenches,) [N]; infinite where no forces balance it."""

    def __post_init__(self) -> None:
        wrenches, phi = self.wrenches, self.phi
        if wrenches.ndim != 2 or wrenches.shape[1] != 6 or not len(wrenches) or not np.isfinite(wrenches).all():
            raise SimulationError(
                f"wrenches have shape {wrenches.shape}; a simulation needs finite ones, (1 or more, 6)"
            )
        if phi.shape != (len(wrenches),):
            raise SimulationError(f"phi has shape {phi.shape}; expected one value for each of {len(wrenches)} wrenches")

    @classmethod
    def of(cls, rigid_object: Graspable, grasp: Grasp) -> "LoadedGrasp":
        """A planned grasp with the task it was planned for; a planar one as the grasp of a slab.

        Raises:
            SimulationError: When there are no contacts.
        """
        if not grasp.found:
            raise SimulationError(f"there is no grasp to validate: the search ended with status {grasp.status}")
        held, grasp = in_space(rigid_object, grasp)
        return cls(
            rigid_object=held,
            contacts=grasp.contacts,
            reference_point=grasp.task.reference_point,
            wrenches=grasp.task.wrenches,
            phi=grasp.phi,
        )

    @cached_property
    def rho(self) -> float:
        """Predicted force cap of a finger of strength 1 [N]."""
        return float(self.phi.max())

    @cached_property
    def critical_wrench(self) -> int:
        """Index of the wrench that decides rho."""
        return int(self.phi.argmax())

    def friction_limited(self, margin: float) -> Mask:
        """Which wrenches need more than this part of the friction whatever the cap, shape (wrenches,)."""
        return on_friction_limit(self.contacts, self.reference_point, self.wrenches, margin)

    def with_contacts(self, contacts: Contacts) -> "LoadedGrasp":
        """Other contacts under the same loads, predicted anew."""
        phi = predicted_caps(contacts, self.reference_point, self.wrenches)
        return replace(self, contacts=contacts, phi=phi)

    def require_predictions(self) -> None:
        """Refuse predictions about which no cap can be searched.

        Raises:
            SimulationError: When one is not positive and finite.
        """
        if not (np.isfinite(self.phi) & (self.phi > 0)).all():
            raise SimulationError(f"phi must be positive and finite to be measured; the least is {self.phi.min()} N")
