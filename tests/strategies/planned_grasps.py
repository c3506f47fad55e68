"""Planned grasps for the tests: an object, contacts, wrenches and what the theory predicts for them."""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.rigid_object import ConvexPart
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.protocol import ACTIVE, ValidationProtocol
from sim.validation.validation import Validation, validate_contacts
from tests.strategies.parts import rigid_object


@dataclass(frozen=True, eq=False, kw_only=True)
class Planned:
    """A grasp and its required wrenches, body frame, SI."""

    parts: tuple[ConvexPart, ...]
    contacts: Contacts
    reference_point: Floats
    wrenches: Floats

    @cached_property
    def phi(self) -> Floats:
        """Predicted cap of each wrench [N]."""
        solver = MinimaxForces(len(self.contacts), 3)
        return np.array(
            [
                solver.solve(
                    ForceProblem(contacts=self.contacts, reference_point=self.reference_point, wrench=wrench)
                ).phi
                for wrench in self.wrenches
            ]
        )

    def validated(
        self, *, rho_error: float = 1.0, friction_error: float = 1.0, protocol: ValidationProtocol = ACTIVE
    ) -> Validation:
        """Validation with rho and the simulated friction multiplied by their errors."""
        grasp = replace(self.loaded, phi=rho_error * self.phi)
        return validate_contacts(grasp, protocol, simulated_friction=friction_error * self.contacts.friction)

    @property
    def loaded(self) -> LoadedGrasp:
        """The grasp with its predicted caps."""
        return LoadedGrasp(
            rigid_object=rigid_object(*self.parts),
            contacts=self.contacts,
            reference_point=self.reference_point,
            wrenches=self.wrenches,
            phi=self.phi,
        )


def prism(scale: float = 1.0, rotation: Floats | None = None, offset: Floats | None = None) -> Planned:
    """The paper's Case III with its optimal grasp, rho = 0.669 N: legs of 4 cm, height 2 cm, times `scale`.

    Forces grow with the square of the scale. The body frame may be turned and moved.
    """
    turn = np.eye(3) if rotation is None else rotation
    origin = np.zeros(3) if offset is None else offset
    corners = np.array([(-4 / 3, -4 / 3), (8 / 3, -4 / 3), (-4 / 3, 8 / 3)])
    vertices = np.array([(x, y, z) for x, y in corners for z in (-1, 1)])
    points = np.array([(2 / 9, -4 / 3, 0), (2 / 3, 2 / 3, 0), (-4 / 3, 2 / 9, 0)])
    normals = np.array([(0, 1, 0), (-np.sqrt(0.5), -np.sqrt(0.5), 0), (1, 0, 0)])
    length, force = 0.01 * scale, 0.16 * scale**2
    half_sides = force * np.repeat([1.0, 0.8 * 2 * np.sqrt(2) / 3 * length], 3)
    box = np.array(list(product((-1, 1), repeat=6))) * half_sides
    return Planned(
        parts=(Polyhedron.hull(length * vertices @ turn.T + origin, geom="prism", friction=0.3),),
        contacts=Contacts(points=length * points @ turn.T + origin, normals=normals @ turn.T, friction=np.full(3, 0.3)),
        reference_point=origin,
        wrenches=np.hstack([box[:, :3] @ turn.T, box[:, 3:] @ turn.T]),
    )


def with_friction(planned: Planned, friction: tuple[float, ...]) -> Planned:
    """The same grasp with its own coefficient at every contact."""
    contacts = replace(planned.contacts, friction=np.array(friction))
    return replace(planned, contacts=contacts)
