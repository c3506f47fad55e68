"""The validation of one wrench with every step kept: what the pictures show.

Two simulations run as in `grasp-validate`, with the cap above and below the force that the wrench needs. There a lost
object is left alone as soon as its outcome is known; here it is followed until it has gone FAR, so that one sees where
it goes. Everything is in the units of the experiment (sim/scene/units.py).
"""

from dataclasses import dataclass, replace
from functools import cached_property

import mujoco
import numpy as np

from planner.arrays import Floats
from planner.errors import SettingError, SimulationError
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.scene.fingertips import FORCE, FOUND, TORQUE
from sim.trial.experiment import Experiment, set_up
from sim.trial.final_state import FinalState
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.measurement import Measurement, measure
from sim.trial.protocol import ValidationProtocol
from sim.trial.schedule import fractions
from sim.trial.trial import Trial, run

FAR = 0.3
"""A lost object that has moved so far is left there: translation relative to the reach, rotation in radians."""
FROM_TIP = np.array([[-1.0], [-1.0], [1.0]])
"""Contact frames look from MuJoCo's first geom. Where that is not the fingertip, the sensor, which looks from the
fingertip, turns the frame about its second tangent."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Recording:
    """A trial, step by step: what MuJoCo had and what it read."""

    experiment: Experiment

    trial: Trial
    """One wrench, one simulation per cap."""

    wrench: int
    """Index of the wrench in the task."""

    need: float
    """phi: the force cap that the wrench is predicted to need [N of the user]."""

    coordinates: Floats
    """qpos before every step and after the last, shape (steps + 1, simulations, nq)."""

    readings: Floats
    """What the contact sensors read during every step, shape (steps, simulations, contacts, SENSOR_WIDTH)."""

    measurement: Measurement
    """How every simulation ended."""

    @property
    def steps(self) -> int:
        """Number of time steps; fewer than the schedule's if every object was lost."""
        return len(self.readings)

    @property
    def times(self) -> Floats:
        """Time at the end of every step, shape (steps,) [s]."""
        return np.arange(1.0, self.steps + 1) * self.experiment.protocol.timestep

    @property
    def loads(self) -> Floats:
        """Part of the wrench of the task that acts during every step, shape (steps,); see sim/trial/schedule.py."""
        return fractions(self.experiment.protocol)[: self.steps, 1]

    @property
    def as_predicted(self) -> bool:
        """Whether the grasp held above what the wrench needs, and did not below."""
        return bool((self.measurement.held == (self.measurement.caps > self.need)).all())

    def summary(self) -> list[str]:
        """What happened, one line per simulation."""
        measured, protocol = self.measurement, self.experiment.protocol
        ends = zip(measured.caps, measured.held, measured.gone(protocol), strict=True)
        return [
            f"wrench {self.wrench} with the cap at {cap / self.need:g} of the {self.need:.5g} N it needs: "
            f"{outcome(held, slip, protocol)}; {self.slip_words(measured, row)}"
            for row, (cap, held, slip) in enumerate(ends)
        ]

    def slip_words(self, measured: Measurement, row: int) -> str:
        """The largest slip of one simulation, and where there are soft fingers their largest spin."""
        spin = f" · spin {measured.spin[row]:.2g} rad" if self.experiment.grasp.contacts.torsions.any() else ""
        return f"slip {measured.slip[row]:.2g} R0{spin}"

    def motion(self, simulation: int) -> tuple[Floats, Floats, Floats]:
        """Where everything was before each step: positions, shape (steps, 3) [m], and rotations (w, x, y, z), shape
        (steps, 4), of the object, and the fingertips' displacements, shape (steps, contacts, 3) [m]."""
        joints = self.experiment.scene.joints
        coordinates = self.coordinates[:-1, simulation]
        displacements = coordinates[:, joints.positions :].reshape(self.steps, -1, 3)
        return *joints.pose(coordinates), displacements

    def measured(self, simulation: int) -> Measurement:
        """One simulation judged after every step, as if it had ended there; one row per step."""
        scene, protocol = self.experiment.scene, self.experiment.protocol
        coordinates, readings = self.coordinates[1:, simulation], self.readings[:, simulation]
        positions, quaternions = scene.joints.pose(coordinates)
        states = FinalState(
            object_positions=positions,
            object_quaternions=quaternions,
            tip_displacements=coordinates[:, scene.joints.positions :].reshape(self.steps, -1, 3),
            touching=readings[:, :, FOUND] > 0,
            contact_forces=readings[:, :, FORCE],
            contact_torques=readings[:, :, TORQUE],
        )
        repeated = Trial(
            **{name: np.repeat(rows[[simulation]], self.steps, 0) for name, rows in vars(self.trial).items()}
        )
        return measure(scene, repeated, states, 1 / self.experiment.units.force, protocol)

    def forces(self, step: int, simulation: int) -> Floats:
        """Measured forces of the fingers on the object during one step, in world axes, shape (contacts, 3) [N].

        The sensors read in contact frames. MuJoCo finds contacts where the bodies are before the step, and finds the
        same ones again when they are put back there. Of a fingertip that touches several parts the sensor read the
        contact with the largest force, here taken to be the deepest.
        """
        scene = self.experiment.scene
        data = self._replayed
        data.qpos[:] = self.coordinates[step, simulation]
        mujoco.mj_fwdPosition(scene.model, data)
        forces = np.zeros((len(scene.tip_geoms), 3))
        for finger, tip in enumerate(scene.tip_geoms):
            contacts = [contact for contact in data.contact if tip in (contact.geom1, contact.geom2)]
            if contacts and self.readings[step, simulation, finger, FOUND] > 0:
                deepest = min(contacts, key=lambda contact: contact.dist)
                frame = deepest.frame.reshape(3, 3)
                if deepest.geom1 != tip:
                    frame = frame * FROM_TIP
                forces[finger] = self.readings[step, simulation, finger, FORCE] @ frame
        return forces

    @cached_property
    def _replayed(self) -> mujoco.MjData:
        """Where contacts are found again: made once, since making it takes fifty times longer than that."""
        return mujoco.MjData(self.experiment.scene.model)


def known_outcome(measured: Measurement, step: int, protocol: ValidationProtocol) -> str:
    """How a simulation, judged after every step, has ended by one of them, in a word; empty while that is open."""
    slip = float(measured.gone(protocol)[step])
    if slip < protocol.slip_tolerance and step < len(measured.held) - 1:
        return ""
    return outcome(bool(measured.held[step]), slip, protocol)


def outcome(held: bool, slip: float, protocol: ValidationProtocol) -> str:
    """How a simulation ended, in a word; see `gone` for the slip."""
    if held:
        return "held"
    return "slipped" if slip >= protocol.slip_tolerance else "lost"


def record(
    rigid_object: RigidObject, grasp: Grasp, wrench: int | None = None, protocol: ValidationProtocol | None = None
) -> Recording:
    """Run one wrench with the cap just above and just below what it needs.

    Args:
        rigid_object: What the fingers hold, in space.
        grasp: Its grasp, in space.
        wrench: Which wrench; by default the critical one, which needs rho.
        protocol: Settings; by default those for such contacts, `active_protocol`.

    Raises:
        SettingError: When there is no such wrench, or it needs no force.
        SimulationError: When there is no grasp, or the experiment cannot be built or run as described.
    """
    if not grasp.found:
        raise SimulationError(f"there is no grasp to show: the search ended with status {grasp.status}")
    shown = grasp.critical_wrench if wrench is None else wrench
    if not 0 <= shown < len(grasp.phi):
        raise SettingError(f"wrench {shown} is not one of the task's; allowed: 0 to {len(grasp.phi) - 1}")
    need = float(grasp.phi[shown])
    if not need > 0:
        raise SettingError(f"wrench {shown} needs no fingertip force, so no cap lets it slip; choose another")
    experiment = set_up(LoadedGrasp.of(rigid_object, grasp), protocol)
    if reasons := experiment.static.reasons():
        raise SimulationError("; ".join(reasons))
    protocol = experiment.protocol
    caps = np.array([protocol.hold_factor, protocol.control_factor]) * need / grasp.rho
    trial = experiment.active(np.repeat(grasp.task.wrenches[[shown]], len(caps), axis=0), caps)
    coordinates, readings = [np.tile(experiment.scene.model.qpos0, (len(caps), 1))], []

    def keep(positions: Floats, sensors: Floats) -> None:
        coordinates.append(positions.copy())
        readings.append(sensors.copy())

    final = run(experiment.scene, trial, replace(protocol, gone=FAR / protocol.motion_tolerance), keep)
    return Recording(
        experiment=experiment,
        trial=trial,
        wrench=shown,
        need=need,
        coordinates=np.array(coordinates),
        readings=np.array(readings),
        measurement=measure(experiment.scene, trial, final, 1 / experiment.units.force, protocol),
    )
