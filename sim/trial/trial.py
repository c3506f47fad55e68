"""One run of the experiment: many simulations of one scene, each with its own wrench and cap.

All are stepped together by mujoco.batch, bit-identical at any number of threads.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from mujoco import batch

from planner.errors import SimulationError
from sim.scene.fingertips import FORCE, FOUND, SENSOR_WIDTH, TORQUE
from sim.scene.scene import Scene
from sim.trial.final_state import FinalState
from sim.trial.force_law import FingerLaw
from sim.trial.protocol import ValidationProtocol
from sim.trial.schedule import fractions

Observer = Callable[[np.ndarray, np.ndarray], None]
"""Is shown every step: qpos after it, shape (simulations, nq), and what the contact sensors read during it, shape
(simulations, contacts, SENSOR_WIDTH). Both arrays are overwritten by the next step."""

LOOK_EVERY = 10
"""Steps between two looks for objects that are lost."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Trial:
    """What is done to the grasp, per simulation, in the units of the experiment."""

    wrenches: np.ndarray
    """Final external wrenches, shape (simulations, 6) [N, N m]."""

    caps: np.ndarray
    """Largest force norm of a finger of strength 1, shape (simulations,) [N]."""

    preloads: np.ndarray
    """Feed-forward forces before the load, shape (simulations, contacts, 3) [N]."""

    preload_wrenches: np.ndarray
    """External wrenches that balance the preloads, shape (simulations, 6) [N, N m]; zero for an internal force."""

    forces: np.ndarray
    """Feed-forward forces under the full wrench, shape (simulations, contacts, 3) [N]."""

    torques: np.ndarray
    """About the normals, that balance takes beside them, shape (simulations, contacts) [N m]; zero at hard fingers."""

    def at(self, squeeze: float, load: float) -> tuple[np.ndarray, np.ndarray]:
        """Wrenches and feed-forward forces at a squeeze s and a load fraction a; see sim/trial/schedule.py."""
        return (
            squeeze * self.preload_wrenches + load * (self.wrenches - self.preload_wrenches),
            squeeze * self.preloads + load * (self.forces - self.preloads),
        )


def run(scene: Scene, trial: Trial, protocol: ValidationProtocol, observe: Observer = lambda *_: None) -> FinalState:
    """Step every simulation through the schedule, and show every step.

    Raises:
        SimulationError: When MuJoCo stops a simulation.
    """
    loads = (trial.at(squeeze, load) for squeeze, load in fractions(protocol))
    return step_through(scene, loads, trial.caps, protocol, observe, protocol.lost)


def step_through(
    scene: Scene,
    loads: Iterable[tuple[np.ndarray, np.ndarray]],
    caps: np.ndarray,
    law: FingerLaw,
    observe: Observer = lambda *_: None,
    lost: Callable[[FinalState], np.ndarray] | None = None,
) -> FinalState:
    """Step every simulation through given loads.

    Args:
        scene: What is stepped.
        loads: For every step the external wrenches, shape (simulations, 6), and the feed-forward forces, shape
            (simulations, contacts, 3), in the units of the scene.
        caps: Largest force norm of a finger of strength 1, shape (simulations,) [N].
        law: How the fingers answer.
        observe: Shown every step.
        lost: Which objects, shape (simulations,), are past return: their outcome is known, and they are left where
            they are.

    Raises:
        SimulationError: When MuJoCo stops a simulation, or loses one.
    """
    simulations, fingers, joints = len(caps), len(scene.contacts), scene.joints
    batched = batch.Batch(scene.model, simulations)
    positions, velocities = batched.bind("qpos"), batched.bind("qvel")
    joint_forces = batched.bind("qfrc_applied")[:, joints.velocities :]
    external = batched.bind("xfrc_applied")[:, scene.object_body]
    sensors = batched.bind("sensordata").reshape(simulations, fingers, SENSOR_WIDTH)
    displacements = positions[:, joints.positions :].reshape(simulations, fingers, 3)
    rates = velocities[:, joints.velocities :].reshape(simulations, fingers, 3)

    def state() -> FinalState:
        object_positions, object_quaternions = joints.pose(positions)
        return FinalState(
            object_positions=object_positions,
            object_quaternions=object_quaternions,
            tip_displacements=displacements.copy(),
            touching=sensors[:, :, FOUND] > 0,
            contact_forces=sensors[:, :, FORCE].copy(),
            contact_torques=sensors[:, :, TORQUE].copy(),
        )

    finger_caps = caps[:, None] * scene.contacts.strengths
    present = np.arange(simulations, dtype=np.int32)
    try:
        for step, (wrenches, feed_forward) in enumerate(loads, start=1):
            forces = law.forces(feed_forward, displacements, rates, finger_caps)
            joint_forces[:] = forces.reshape(simulations, -1)
            external[:] = wrenches
            batched.step(present)
            observe(positions, sensors)
            if lost is not None and step % LOOK_EVERY == 0:
                present = np.flatnonzero(~lost(state())).astype(np.int32)
                if not present.size:
                    break
    except batch.SimulationError as error:
        raise SimulationError(f"MuJoCo stopped a simulation: {error}") from error
    if not np.isfinite(positions).all():
        raise SimulationError("a simulation diverged; its fingertips may overlap the object or each other")
    return state()
