"""The validation file: the verdict with its evidence and every setting, as one versioned JSON document."""

from collections.abc import Sequence
from pathlib import Path

import msgspec

from planner.atomic_write import write_atomically
from sim.measurement import Measurement
from sim.protocol import ValidationProtocol
from sim.validate import Validation

FORMAT, FORMAT_VERSION = "rhograsp.validation", 1


class FingerRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One finger in one simulation."""

    slip: float
    """Sliding over R0."""
    separation: float
    """Distance from where it touched, outward, over R0."""
    predicted_force: float
    """Norm of the commanded contact force [N]."""
    measured_force: float
    """Norm of the contact force in MuJoCo [N]."""
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
    translation: float
    """Displacement of the object over R0."""
    rotation: float
    """Rotation of the object [rad]."""
    fingers: tuple[FingerRecord, ...]


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
    verdict: bool
    """Whether rho is confirmed."""
    reasons: tuple[str, ...]
    """Why not; empty when confirmed."""
    rho: float
    """Predicted force cap [N]."""
    critical_wrench: int
    """Index of the wrench that decides rho."""
    planned_friction: tuple[float, ...]
    simulated_friction: tuple[float, ...]
    static: StaticRecord
    vertices: tuple[SimulationRecord, ...]
    """Every wrench with the cap above rho; empty if the static check failed."""
    controls: tuple[SimulationRecord, ...]
    """What must slip: the critical wrench with the cap below rho."""
    protocol: ValidationProtocol
    """Name, settings and thresholds."""
    versions: dict[str, str]
    """Versions of the packages that can change the outcome."""


def to_document(validation: Validation, *, grasp: str | None = None) -> ValidationDocument:
    """The validation as plain values; `grasp` names the grasp file."""
    vertices, control, static = validation.vertices, validation.control, validation.static
    return ValidationDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        grasp=grasp,
        object=ObjectRecord(sha256=validation.rigid_object.sha256, body=validation.rigid_object.body),
        verdict=validation.verdict,
        reasons=validation.reasons,
        rho=validation.rho,
        critical_wrench=validation.critical_wrench,
        planned_friction=tuple(validation.planned_friction.tolist()),
        simulated_friction=tuple(validation.simulated_friction.tolist()),
        static=StaticRecord(
            distances=tuple(static.distances.tolist()),
            touches=tuple(static.touches.tolist()),
            tip_radius=static.tip_radius,
            tolerance=static.tolerance,
        ),
        vertices=_records(vertices, range(len(validation.phi)), validation) if vertices else (),
        controls=_records(control, [validation.critical_wrench], validation) if control else (),
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
    document = msgspec.json.encode(to_document(validation, grasp=grasp))
    write_atomically(path, msgspec.json.format(document, indent=1) + b"\n")


def _records(measurement: Measurement, wrenches: Sequence[int], validation: Validation) -> tuple[SimulationRecord, ...]:
    columns = zip(
        wrenches,
        measurement.caps.tolist(),
        measurement.held.tolist(),
        measurement.slip.tolist(),
        measurement.translations.tolist(),
        measurement.rotations.tolist(),
        strict=True,
    )
    return tuple(
        SimulationRecord(
            wrench=wrench,
            phi=float(validation.phi[wrench]),
            cap=cap,
            held=held,
            slip=slip,
            translation=translation,
            rotation=rotation,
            fingers=_fingers(measurement, row),
        )
        for row, (wrench, cap, held, slip, translation, rotation) in enumerate(columns)
    )


def _fingers(measurement: Measurement, row: int) -> tuple[FingerRecord, ...]:
    names = FingerRecord.__struct_fields__
    arrays = (
        measurement.slips,
        measurement.separations,
        measurement.predicted_forces,
        measurement.measured_forces,
        measurement.loaded,
        measurement.lost,
    )
    columns = zip(*(array[row].tolist() for array in arrays), strict=True)
    return tuple(FingerRecord(**dict(zip(names, values, strict=True))) for values in columns)
