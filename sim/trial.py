"""One run of the experiment: many simulations of one scene, each with its own wrench and cap.

All are stepped together by mujoco.batch, bit-identical at any number of threads.
"""

from dataclasses import dataclass

import numpy as np
from mujoco import batch

from planner.errors import SimulationError
from sim.force_law import finger_forces
from sim.protocol import ValidationProtocol
from sim.scene import (
    OBJECT_POSITION,
    OBJECT_QUATERNION,
    SENSOR_WIDTH,
    TIP_POSITIONS,
    TIP_VELOCITIES,
    Scene,
)
from sim.schedule import fractions


@dataclass(frozen=True, eq=False, kw_only=True)
class Trial:
    """What is done to the grasp, per simulation, in the units of the experiment."""

    wrenches: np.ndarray
    """Final external wrenches, shape (simulations, 6) [N, N m]."""

    caps: np.ndarray
    """Largest force norm per finger, shape (simulations,) [N]."""

    preloads: np.ndarray
    """Internal forces before the load, shape (simulations, contacts, 3) [N]."""

    forces: np.ndarray
    """Feed-forward forces under the full wrench, shape (simulations, contacts, 3) [N]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FinalState:
    """Where everything is at the end, per simulation, in the units of the experiment."""

    object_positions: np.ndarray
    """Displacement of the object, shape (simulations, 3) [m]."""

    object_quaternions: np.ndarray
    """Rotation of the object (w, x, y, z), shape (simulations, 4)."""

    tip_displacements: np.ndarray
    """Displacements of the fingertips from their anchors, shape (simulations, contacts, 3) [m]."""

    touching: np.ndarray
    """Whether each fingertip touches the object, shape (simulations, contacts)."""

    contact_forces: np.ndarray
    """Norms of the measured contact forces, shape (simulations, contacts) [N]."""


def run(scene: Scene, trial: Trial, protocol: ValidationProtocol) -> FinalState:
    """Step every simulation through the schedule.

    Raises:
        SimulationError: When MuJoCo stops a simulation.
    """
    simulations, fingers = trial.forces.shape[:2]
    batched = batch.Batch(scene.model, simulations)
    positions, velocities = batched.bind("qpos"), batched.bind("qvel")
    joint_forces = batched.bind("qfrc_applied")[:, TIP_VELOCITIES]
    external = batched.bind("xfrc_applied")[:, scene.object_body]
    sensors = batched.bind("sensordata")
    displacements = positions[:, TIP_POSITIONS].reshape(trial.forces.shape)
    rates = velocities[:, TIP_VELOCITIES].reshape(trial.forces.shape)
    growth = trial.forces - trial.preloads
    caps = trial.caps[:, None]
    try:
        for squeeze, load in fractions(protocol):
            feed_forward = squeeze * trial.preloads + load * growth
            forces = finger_forces(feed_forward, displacements, rates, caps, protocol.stiffness, protocol.damping)
            joint_forces[:] = forces.reshape(simulations, -1)
            external[:] = load * trial.wrenches
            batched.step()
    except batch.SimulationError as error:
        raise SimulationError(f"MuJoCo stopped the validation: {error}") from error
    if not np.isfinite(positions).all():
        raise SimulationError("a validation simulation diverged; its fingertips may overlap the object or each other")
    sensors = sensors.reshape(simulations, fingers, SENSOR_WIDTH)
    return FinalState(
        object_positions=positions[:, OBJECT_POSITION].copy(),
        object_quaternions=positions[:, OBJECT_QUATERNION].copy(),
        tip_displacements=displacements.copy(),
        touching=sensors[:, :, 0] > 0,
        contact_forces=np.linalg.norm(sensors[:, :, 1:], axis=2),
    )
