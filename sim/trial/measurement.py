"""What the experiment shows: slip, motion, lost contacts and forces of every simulation."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Floats, Mask
from planner.contact_models.friction_cone import components
from planner.contact_models.models import model_of
from sim.scene.scene import Scene
from sim.trial.final_state import FinalState
from sim.trial.protocol import ValidationProtocol
from sim.trial.trial import Trial


@dataclass(frozen=True, eq=False, kw_only=True)
class Measurement:
    """Outcome per simulation. Lengths are relative to R0, the reach of the grasp; forces are the user's."""

    caps: Floats
    """Largest force norm of a finger of strength 1, shape (simulations,) [N]."""

    slips: Floats
    """Sliding of each fingertip along the object's surface over R0, shape (simulations, contacts)."""

    spins: Floats
    """Turn of each soft fingertip against the object about its normal, shape (simulations, contacts) [rad]; zero for
    hard ones, which spin as they like."""

    separations: Floats
    """Distance of each fingertip from where it touched, along the outward normal, over R0, same shape."""

    translations: Floats
    """Displacement of the object at the reference point over R0, shape (simulations,)."""

    rotations: Floats
    """Rotation of the object, shape (simulations,) [rad]."""

    predicted_forces: Floats
    """Norms of the commanded contact forces, shape (simulations, contacts) [N]."""

    measured_forces: Floats
    """Norms of the contact forces MuJoCo reports, shape (simulations, contacts) [N]."""

    predicted_utilisations: Floats
    """|f_t| / f_n of the commanded contact forces, of soft fingers |(f_t, tau mu / gamma)| / f_n with the torques that
    balance takes, shape (simulations, contacts); zero where not loaded."""

    measured_utilisations: Floats
    """The same of the contact forces and torques MuJoCo reports, same shape; zero where not loaded."""

    loaded: Mask
    """Fingers that carry enough to be judged, shape (simulations, contacts)."""

    lost: Mask
    """Loaded fingers that touch nothing, shape (simulations, contacts)."""

    held: Mask
    """Whether each simulation held its wrench, shape (simulations,)."""

    @property
    def slip(self) -> Floats:
        """Largest slip of a loaded finger over R0, shape (simulations,); zero where none is loaded."""
        return np.where(self.loaded, self.slips, 0.0).max(axis=1)

    @property
    def spin(self) -> Floats:
        """Largest spin of a loaded soft finger, shape (simulations,) [rad]; zero where none is."""
        return np.where(self.loaded, self.spins, 0.0).max(axis=1)

    def gone(self, protocol: ValidationProtocol) -> Floats:
        """The largest slip over R0, or the largest spin where that is more of what a hold allows, shape (simulations,).

        A spin counts as the slip that is the same part of its tolerance.
        """
        return np.maximum(self.slip, self.spin / protocol.spin_of_reach)

    def rows(self, selection: slice) -> "Measurement":
        """The selected simulations."""
        return Measurement(**{name: values[selection] for name, values in vars(self).items()})

    @classmethod
    def joined(cls, parts: Sequence["Measurement"]) -> "Measurement":
        """The simulations of all parts, in order; one part or more."""
        return cls(**{name: np.concatenate([vars(part)[name] for part in parts]) for name in vars(parts[0])})


def measure(scene: Scene, trial: Trial, final: FinalState, force: float, protocol: ValidationProtocol) -> Measurement:
    """Judge every simulation by its final state.

    A fingertip does not turn, so the point of it that first touched the object moves, in the object's frame, by
    R^T (p + q - x) - p, with p the contact, q the displacement of the tip and (R, x) the object's pose. Its
    part in the tangent plane is the slip, and the turn of R about the normal the spin.

    Args:
        scene: The scene that was run.
        trial: What was done.
        final: How it ended.
        force: Newtons per newton of the experiment.
        protocol: Thresholds.
    """
    contacts, model = scene.contacts, model_of(scene.contacts)
    points, normals = contacts.points, contacts.normals
    from_object = points + final.tip_displacements - final.object_positions[:, None]
    moved = _unrotated(final.object_quaternions, from_object) - points
    inward, sliding = components(moved, normals)
    slips = sliding / protocol.reach
    spins = np.where(contacts.torsions > 0, final.spins(normals), 0.0)
    translations, rotations = final.translations / protocol.reach, final.rotations
    predicted = np.linalg.norm(trial.forces, axis=2)
    loaded = predicted > protocol.loaded * trial.caps[:, None] * contacts.strengths
    lost = loaded & ~final.touching
    still = (translations < protocol.motion_tolerance) & (rotations < protocol.motion_tolerance)
    gone = lost | (loaded & ((slips >= protocol.slip_tolerance) | (spins >= protocol.spin_tolerance)))
    in_frames = replace(contacts, normals=np.eye(3)[np.zeros(len(contacts), dtype=int)])
    return Measurement(
        caps=trial.caps * force,
        slips=slips,
        spins=spins,
        separations=-inward / protocol.reach,
        translations=translations,
        rotations=rotations,
        predicted_forces=predicted * force,
        measured_forces=np.linalg.norm(final.contact_forces, axis=2) * force,
        predicted_utilisations=np.where(loaded, model.utilisation(trial.forces, trial.torques, contacts), 0.0),
        measured_utilisations=np.where(
            loaded, model.utilisation(final.contact_forces, final.contact_torques, in_frames), 0.0
        ),
        loaded=loaded,
        lost=lost,
        held=still & ~gone.any(axis=1),
    )


def _unrotated(quaternions: Floats, vectors: Floats) -> Floats:
    """R^T v for unit quaternions, shape (n, 4), and vectors, shape (n, m, 3)."""
    scalar, axis = quaternions[:, None, :1], -quaternions[:, None, 1:]
    turned = np.cross(axis, vectors)
    return vectors + 2 * (scalar * turned + np.cross(axis, turned))
