"""Squeeze, tug, look: the test that others put a grasp to, in its own units and under its own thresholds.

The fingers push with an internal force that leans on friction as little as possible, its largest finger at the named
squeeze, and yield like springs; they know nothing of the tugs. This is a squeeze with room to slip, not a measurement
of rho: it has a pass or a fail and no force to compare. More is not always better: a squeeze comparable to K R0, the
stiffness times the reach of the contacts, can turn the object between its springs.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count

import numpy as np

from planner.arrays import Floats, Mask
from planner.contacts import Contacts
from planner.errors import SettingError
from planner.files.package_versions import package_versions
from planner.millimetres import in_mm
from planner.objects.rigid_object import RigidObject
from sim.benches.settings import BenchSettings
from sim.benches.world import build_world
from sim.scene.scene import Scene
from sim.trial.feed_forward import FeedForward
from sim.trial.final_state import angles
from sim.trial.trial import step_through


@dataclass(frozen=True, eq=False, kw_only=True)
class BenchOutcome:
    """Verdict, evidence and every setting of the test."""

    passed: bool

    reasons: tuple[str, ...]
    """Why not, one sentence each; empty when passed."""

    rigid_object: RigidObject

    squeeze: float
    """Named largest force of a fingertip before the tugs [N]."""

    preload: Floats
    """Constant push of each fingertip, body frame, shape (contacts, 3) [N]; zero if these contacts cannot squeeze."""

    translations: Floats
    """Largest displacement of the body's origin at any look, shape (simulations,) [m]."""

    rotations: Floats
    """Largest rotation at any look, shape (simulations,) [rad]."""

    touching: Mask
    """Which fingertips touch the object at the end, shape (simulations, contacts)."""

    tip_radius: float
    """[m]"""

    settings: BenchSettings

    versions: dict[str, str]
    """Of the packages that can change the outcome."""


def run_bench(rigid_object: RigidObject, contacts: Contacts, squeeze: float, settings: BenchSettings) -> BenchOutcome:
    """Run every simulation of a test in one batch and judge it.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp in the body frame; its friction is replaced by the test's.
        squeeze: Largest force with which a fingertip squeezes [N].
        settings: The test.

    Raises:
        SettingError: When the squeeze is not a positive, finite force, or a finger's strength is not 1.
        SimulationError: When a fingertip is not where it was planned or MuJoCo cannot build or run the test.
    """
    if not (np.isfinite(squeeze) and squeeze > 0):
        raise SettingError(f"the squeeze is {squeeze} N; fingertips squeeze with a positive, finite force")
    if (contacts.strengths != 1).any():
        raise SettingError(
            f"the fingers have strengths {contacts.strengths.tolist()}, but {settings.name} squeezes with one force; "
            "validate this grasp with fingers that adapt (--mode active)"
        )
    scene = build_world(rigid_object, contacts, settings)
    preload = FeedForward(scene.contacts, rigid_object.center_of_mass).squeeze(squeeze).forces
    translations, rotations, touching = _simulate(scene, preload, settings)
    reasons = _objections(translations, rotations, touching, settings)
    return BenchOutcome(
        passed=not reasons,
        reasons=reasons,
        rigid_object=rigid_object,
        squeeze=float(squeeze),
        preload=preload,
        translations=translations,
        rotations=rotations,
        touching=touching,
        tip_radius=scene.tip_radius,
        settings=settings,
        versions=package_versions(),
    )


def _simulate(scene: Scene, preload: Floats, settings: BenchSettings) -> tuple[Floats, Floats, Mask]:
    """Largest translations and rotations at any look, and who touches at the end."""
    simulations, look = len(settings.tugs), round(settings.check_interval / settings.timestep)
    squeezing = round(settings.squeeze_time / settings.timestep)
    last = squeezing + round(settings.tug_time / settings.timestep) * len(settings.tugs[0])
    translations, rotations, steps = np.zeros(simulations), np.zeros(simulations), count(1)

    def observe(positions: Floats, _: Floats) -> None:
        nonlocal translations, rotations
        step = next(steps)
        if step > squeezing and ((step - squeezing) % look == 0 or step == last):
            object_positions, object_quaternions = scene.joints.pose(positions)
            translations = np.maximum(translations, np.linalg.norm(object_positions, axis=1))
            rotations = np.maximum(rotations, angles(object_quaternions))

    uncapped = np.full(simulations, np.inf)
    final = step_through(scene, _loads(preload, settings), uncapped, settings, observe)
    return translations, rotations, final.touching


def _loads(preload: Floats, settings: BenchSettings) -> Iterator[tuple[Floats, Floats]]:
    """Of every step: wrenches, shape (simulations, 6) [N, N m], and push of the fingers; a squeeze, then the tugs."""
    tugs = settings.object_mass * settings.tug_acceleration * np.array(settings.tugs, dtype=float)
    tugs = np.concatenate([tugs, np.zeros_like(tugs)], axis=2)
    squeezing, tugging = (round(seconds / settings.timestep) for seconds in (settings.squeeze_time, settings.tug_time))
    for step in range(1, squeezing + 1):
        yield np.zeros_like(tugs[:, 0]), step / squeezing * preload
    for tug in range(tugs.shape[1]):
        for _ in range(tugging):
            yield tugs[:, tug], preload


def _objections(translations: Floats, rotations: Floats, touching: Mask, settings: BenchSettings) -> tuple[str, ...]:
    """One sentence per simulation that breaks the test's rule."""
    sentences = []
    for row, tugs in enumerate(settings.tugs):
        faults = []
        if settings.translation_limit is not None and translations[row] >= settings.translation_limit:
            moved, allowed = in_mm(translations[row], 2), in_mm(settings.translation_limit)
            faults.append(f"the object moved {moved} mm (allowed {allowed})")
        if settings.rotation_limit is not None and rotations[row] >= settings.rotation_limit:
            turned, allowed = np.rad2deg([rotations[row], settings.rotation_limit])
            faults.append(f"the object turned {turned:.3g} degrees (allowed {allowed:.3g})")
        if settings.contact_at_end and not touching[row].all():
            faults.append(f"fingers {np.flatnonzero(~touching[row]).tolist()} do not touch the object at the end")
        if faults:
            pull = ", ".join("({:.2g}, {:.2g}, {:.2g})".format(*tug) for tug in tugs)
            sentences.append(f"pulled along {pull}: {' and '.join(faults)}")
    return tuple(sentences)
