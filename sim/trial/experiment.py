"""A grasp set up in the simulator: every measurement is this, run with other wrenches and caps."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from planner.contacts import Contacts
from planner.objects.rigid_object import ConvexPart
from planner.progress import Done
from sim.scene.fingertips import Fingertips
from sim.scene.floating_object import FloatingObject
from sim.scene.object_joints import ObjectJoints, joints_of
from sim.scene.placement import placed_scene
from sim.scene.scene import Scene, with_friction
from sim.scene.static_check import StaticCheck
from sim.scene.units import Units, units_of
from sim.trial.active import active_trial
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.measurement import Measurement, measure
from sim.trial.protocol import ValidationProtocol, active_protocol
from sim.trial.schedule import steps
from sim.trial.trial import Trial, run
from sim.trial.workload import each_step

MOST_SIMULATIONS = 512
"""Simulations per batch; more would not run faster."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Experiment:
    """The compiled scene of one grasp with its units and protocol."""

    grasp: LoadedGrasp

    units: Units
    scene: Scene
    protocol: ValidationProtocol

    static: StaticCheck
    """Whether the fingertips touch what was planned; what is measured means nothing otherwise."""

    def measure(self, wrenches: np.ndarray, caps: np.ndarray, observe: Done = lambda _: None) -> Measurement:
        """Run all simulations, the forces answering each wrench within its cap.

        They run in batches of at most MOST_SIMULATIONS: the memory is bounded and the progress can be told.

        Args:
            wrenches: One per simulation, shape (simulations, 6) [N, N m].
            caps: One per simulation, relative to rho, shape (simulations,).
            observe: Called after every step with how many simulations are done; half-run ones count half.

        Raises:
            SimulationError: When MuJoCo stops or loses a simulation.
        """
        parts = []
        for start in range(0, len(caps), MOST_SIMULATIONS):
            rows = slice(start, start + MOST_SIMULATIONS)
            trial = self.active(wrenches[rows], caps[rows])
            parts.append(self.perform(trial, _after(start, observe)))
        return Measurement.joined(parts)

    def active(self, wrenches: np.ndarray, caps: np.ndarray) -> Trial:
        """The trial in which the forces answer each wrench within its cap; see `measure`."""
        return active_trial(self.grasp.contacts, self.units, wrenches, caps, self.protocol)

    def perform(self, trial: Trial, observe: Done = lambda _: None) -> Measurement:
        """Run one batch.

        Args:
            trial: What is done.
            observe: Called after every step with how many simulations are done; half-run ones count half.

        Raises:
            SimulationError: When MuJoCo stops or loses a simulation.
        """
        final = run(self.scene, trial, self.protocol, each_step(observe, len(trial.caps), steps(self.protocol)))
        return measure(self.scene, trial, final, 1 / self.units.force, self.protocol)

    def with_friction(self, contacts: Contacts) -> "Experiment":
        """The same experiment with other friction and torsional friction in the simulator; no finger is told.

        Args:
            contacts: The planned ones, body frame, SI, but for friction and torsion.

        Raises:
            SimulationError: When a torsional friction is too small for MuJoCo.
        """
        return replace(self, scene=with_friction(self.scene, self.units.contacts(contacts)))


def _after(before: int, observe: Done) -> Done:
    """The observer of a batch that begins when so many simulations are done."""
    return lambda done: observe(before + done)


def set_up(
    grasp: LoadedGrasp,
    protocol: ValidationProtocol | None = None,
    friction: np.ndarray | None = None,
    newton: float | None = None,
) -> Experiment:
    """Compose and compile the scene with the largest fingertips that touch only where planned.

    Those that confirmed the candidates are among them. If even the smallest touch anything else, the static check says
    which.

    Args:
        grasp: What is measured.
        protocol: Settings; by default those for such contacts, `active_protocol`.
        friction: Friction in the simulator, shape (contacts,), with the torsional friction that goes with it; the
            planned one if None.
        newton: The experiment's newton [N]; rho if None.

    Raises:
        SimulationError: When the experiment cannot be built.
        ContactError: When the friction is not one positive number per contact.
    """
    rigid_object, contacts = grasp.rigid_object, grasp.contacts
    protocol = protocol or active_protocol(contacts)
    force = grasp.rho if newton is None else newton
    units = units_of(contacts, grasp.reference_point, force, protocol.reach)
    held = floating_object(rigid_object.parts, units, protocol, joints_of(rigid_object))
    touching = units.contacts(contacts if friction is None else contacts.with_friction(np.asarray(friction, float)))
    tips = Fingertips(contacts=touching, radius=0.0, mass=protocol.tip_mass)
    radii = [radius * protocol.reach for radius in protocol.tip_radii]
    scene, static = placed_scene(held, tips, protocol, radii, rigid_object.size)
    return Experiment(grasp=grasp, units=units, scene=scene, protocol=protocol, static=static)


def floating_object(
    parts: Sequence[ConvexPart], units: Units, protocol: ValidationProtocol, joints: ObjectJoints
) -> FloatingObject:
    """The object with its centre of mass at the reference point, where MuJoCo then applies the wrenches.

    Args:
        parts: Its collision geoms, in the body frame, SI.
        units: Map to the units of the experiment.
        protocol: Settings.
        joints: How it may move.
    """
    return FloatingObject(
        parts=parts,
        units=units,
        mass=protocol.object_mass,
        center_of_mass=np.zeros(3),
        inertia=protocol.object_mass * protocol.reach**2 * np.eye(3),
        joints=joints,
        drag=protocol.object_damping,
    )
