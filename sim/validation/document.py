"""The validation file: the verdict with its evidence and every setting, as one versioned JSON document."""

from pathlib import Path

import msgspec
import numpy as np

from planner.files.json_document import finite_or_none
from planner.files.versioned_document import write_document
from sim.trial.measurement import Measurement
from sim.trial.protocol import ValidationProtocol
from sim.validation.beyond import Beyond
from sim.validation.control_experiment import ControlExperiment
from sim.validation.critical_force import CriticalForce
from sim.validation.force_agreement import ForceAgreement
from sim.validation.validation import Validation
from sim.validation.verdict import Verdict

FORMAT, FORMAT_VERSION = "rhograsp.validation", 1


class FingerRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One finger in one simulation."""

    slip: float
    """Sliding over R0."""
    spin: float = 0.0
    """Turn about its normal against the object [rad]; 0 for a finger without torsional friction."""
    separation: float
    """Distance from where it touched, outward, over R0."""
    predicted_force: float
    """Norm of the commanded contact force [N]."""
    measured_force: float
    """Norm of the contact force in MuJoCo [N]."""
    predicted_utilisation: float
    """|f_t| / f_n of the commanded contact force; with torsional friction |(f_t, tau mu / gamma)| / f_n, with the
    torque tau that balance takes."""
    measured_utilisation: float
    """The same of the contact force and torque in MuJoCo."""
    loaded: bool
    """Whether it carries enough to be judged."""
    lost: bool
    """Whether it is loaded and touches nothing."""


class SimulationRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One wrench at one cap."""

    wrench: int
    """Index among the vertices of the required external force set."""
    phi: float
    """Predicted least cap for this wrench [N]."""
    cap: float
    """Simulated cap [N]."""
    held: bool
    slip: float
    """Largest slip of a loaded finger over R0."""
    spin: float = 0.0
    """Largest spin of a loaded finger with torsional friction [rad]."""
    translation: float
    """Displacement of the object over R0."""
    rotation: float
    """Rotation of the object [rad]."""
    fingers: tuple[FingerRecord, ...]


class OutcomeRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One simulation of a control."""

    wrench: int | None
    """Index among the vertices; null for no load."""
    phi: float | None
    """Predicted least cap under the control's change [N]; null if no cap suffices."""
    cap: float
    """Simulated cap [N]."""
    slip: float
    """Largest slip of a loaded finger over R0."""
    spin: float = 0.0
    """Largest spin of a loaded finger with torsional friction [rad]."""
    held: bool
    expected: bool
    """Whether theory says it is held."""
    counted: bool
    """Whether the prediction is far enough from the cap to be called."""


class ControlRecord(msgspec.Struct, frozen=True, kw_only=True):
    """What must happen if the experiment is to be believed."""

    name: str
    change: str
    """What was changed."""
    behaved: bool
    """Whether all that counts turned out as predicted."""
    outcomes: tuple[OutcomeRecord, ...]
    """Empty if the control is not possible on this grasp."""


class CapRecord(msgspec.Struct, frozen=True, kw_only=True):
    """The measured least cap of one wrench."""

    wrench: int
    phi: float
    """Predicted [N]."""
    lower: float
    """Largest cap that was seen to slip [N]; zero if even the lowest tried held."""
    upper: float | None
    """Least cap that was seen to hold [N]; null if even the highest tried slipped."""
    ratio: float | None
    """Middle of the bracket over phi."""


class CriticalForceRecord(msgspec.Struct, frozen=True, kw_only=True):
    """rho as measured."""

    lower: float
    """Largest cap with which some wrench was seen to slip [N]."""
    upper: float | None
    """Least cap with which every wrench was seen to hold [N]."""
    ratio: float | None
    """Middle of the bracket over the predicted rho."""
    critical_wrench: int
    """The wrench with the largest measured cap."""
    wrenches: tuple[CapRecord, ...]


class LoadsRecord(msgspec.Struct, frozen=True, kw_only=True):
    """Loads of one kind other than the vertices."""

    kind: str
    loads: int
    held: int
    must_hold: bool
    """Else all must slip."""
    slips: tuple[float, ...]
    """Largest slip of a loaded finger over R0, per load."""


class ObjectRecord(msgspec.Struct, frozen=True, kw_only=True):
    """The object that was held."""

    sha256: str
    """Digest of its files."""
    body: str
    """The body whose frame is B."""


class StaticRecord(msgspec.Struct, frozen=True, kw_only=True):
    """Where the fingertips were before anything moved."""

    distances: tuple[float, ...]
    """Signed distance of each fingertip to the object [m]."""
    touches: tuple[int, ...]
    """Number of the object's geoms each fingertip touches."""
    tip_radius: float
    """Radius of the fingertips [m]."""
    tolerance: float
    """Largest |distance| of a fingertip that touches [m]."""


class ValidationDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The whole document."""

    format: str
    format_version: int
    grasp: str | None
    """Name of the grasp file; null if the grasp came from memory."""
    object: ObjectRecord
    verdict: Verdict
    """pass, fail, or not trustworthy: a control did not behave."""
    reasons: tuple[str, ...]
    """Why not pass; empty when it is."""
    rho: float
    """Predicted force cap [N]."""
    critical_wrench: int
    """Index of the wrench that decides rho."""
    strengths: tuple[float, ...] = ()
    """Of the fingers: the cap of each is its strength times the stated one. Empty: all 1, in files of old."""
    planned_friction: tuple[float, ...]
    simulated_friction: tuple[float, ...]
    planned_torsion: tuple[float, ...] = ()
    """Torsional friction of every finger [m]. Empty: none, in files of old."""
    simulated_torsion: tuple[float, ...] = ()
    """[m]"""
    static: StaticRecord
    friction_limited: tuple[int, ...] = ()
    """Wrenches on the friction limit, held or not: whatever the cap, they need more than `friction_margin` (see
    protocol) of the planned friction. Not recorded in files of old."""
    vertices: tuple[SimulationRecord, ...]
    """Every wrench with the cap above rho; empty if the static check failed."""
    forces: ForceAgreement | None
    """Predicted against measured forces of all vertices; null if the static check failed."""
    controls: tuple[ControlRecord, ...]
    """Empty if the static check failed."""
    critical_force: CriticalForceRecord | None
    """Measured caps; null if not asked for."""
    beyond: tuple[LoadsRecord, ...]
    """Loads other than the vertices; empty if not asked for."""
    protocol: ValidationProtocol
    """Name, settings and thresholds."""
    versions: dict[str, str]
    """Versions of the packages that can change the outcome."""


def to_document(validation: Validation, *, grasp: str | None = None) -> ValidationDocument:
    """The validation as plain values; `grasp` names the grasp file."""
    vertices, static, held = validation.vertices, validation.static, validation.grasp
    return ValidationDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        grasp=grasp,
        object=ObjectRecord(sha256=held.rigid_object.sha256, body=held.rigid_object.body),
        verdict=validation.verdict,
        reasons=validation.reasons,
        rho=held.rho,
        critical_wrench=held.critical_wrench,
        strengths=tuple(held.contacts.strengths.tolist()),
        planned_friction=tuple(held.contacts.friction.tolist()),
        simulated_friction=tuple(validation.simulated_friction.tolist()),
        planned_torsion=tuple(held.contacts.torsions.tolist()),
        simulated_torsion=tuple(validation.simulated_torsion.tolist()),
        static=StaticRecord(
            distances=tuple(static.distances.tolist()),
            touches=tuple(static.touches.tolist()),
            tip_radius=static.tip_radius,
            tolerance=static.tolerance,
        ),
        friction_limited=tuple(np.flatnonzero(validation.limited).tolist()),
        vertices=_records(vertices, validation) if vertices else (),
        forces=validation.forces,
        controls=tuple(_control(control) for control in validation.controls),
        critical_force=_critical_force(validation.critical_force) if validation.critical_force else None,
        beyond=_loads(validation.beyond) if validation.beyond else (),
        protocol=validation.protocol,
        versions=validation.versions,
    )


def write_validation(path: Path, validation: Validation, *, grasp: str | None = None) -> None:
    """Write the document: a reader sees the old file or the whole new one.

    Args:
        path: By convention ends in `.validation.json`.
        validation: What to write.
        grasp: Name of the grasp file that was validated.

    Raises:
        OutputError: When `path` cannot be written.
    """
    write_document(path, to_document(validation, grasp=grasp))


def _control(control: ControlExperiment) -> ControlRecord:
    columns = (
        control.wrenches,
        control.phi,
        control.caps,
        control.slips,
        control.spins,
        control.held,
        control.expected,
        control.counted,
    )
    return ControlRecord(
        name=control.name,
        change=control.change,
        behaved=control.behaved,
        outcomes=tuple(
            OutcomeRecord(
                wrench=wrench if wrench >= 0 else None,
                phi=finite_or_none(phi),
                cap=cap,
                slip=slip,
                spin=spin,
                held=held,
                expected=expected,
                counted=counted,
            )
            for wrench, phi, cap, slip, spin, held, expected, counted in zip(
                *(c.tolist() for c in columns), strict=True
            )
        ),
    )


def _critical_force(critical: CriticalForce) -> CriticalForceRecord:
    columns = (critical.phi, critical.lower, critical.upper, critical.ratios)
    rows = zip(*(column.tolist() for column in columns), strict=True)
    lower, upper = critical.rho
    return CriticalForceRecord(
        lower=lower,
        upper=finite_or_none(upper),
        ratio=finite_or_none(critical.ratio),
        critical_wrench=critical.critical_wrench,
        wrenches=tuple(
            CapRecord(wrench=wrench, phi=phi, lower=low, upper=finite_or_none(high), ratio=finite_or_none(ratio))
            for wrench, (phi, low, high, ratio) in enumerate(rows)
        ),
    )


def _loads(beyond: Beyond) -> tuple[LoadsRecord, ...]:
    return tuple(
        LoadsRecord(
            kind=kind,
            loads=len(outcome.held),
            held=int(outcome.held.sum()),
            must_hold=must_hold,
            slips=tuple(outcome.slip.tolist()),
        )
        for kind, outcome, must_hold in beyond.kinds()
    )


def _records(measurement: Measurement, validation: Validation) -> tuple[SimulationRecord, ...]:
    columns = zip(
        validation.grasp.phi.tolist(),
        measurement.caps.tolist(),
        measurement.held.tolist(),
        measurement.slip.tolist(),
        measurement.spin.tolist(),
        measurement.translations.tolist(),
        measurement.rotations.tolist(),
        strict=True,
    )
    return tuple(
        SimulationRecord(
            wrench=wrench,
            phi=phi,
            cap=cap,
            held=held,
            slip=slip,
            spin=spin,
            translation=translation,
            rotation=rotation,
            fingers=_fingers(measurement, wrench),
        )
        for wrench, (phi, cap, held, slip, spin, translation, rotation) in enumerate(columns)
    )


def _fingers(measurement: Measurement, row: int) -> tuple[FingerRecord, ...]:
    names = FingerRecord.__struct_fields__
    arrays = (
        measurement.slips,
        measurement.spins,
        measurement.separations,
        measurement.predicted_forces,
        measurement.measured_forces,
        measurement.predicted_utilisations,
        measurement.measured_utilisations,
        measurement.loaded,
        measurement.lost,
    )
    columns = zip(*(array[row].tolist() for array in arrays), strict=True)
    return tuple(FingerRecord(**dict(zip(names, values, strict=True))) for values in columns)
