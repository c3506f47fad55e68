"""The validation file: the verdict with its evidence and every setting, as one versioned JSON document.

What is plain values in memory stands in the file as it is. A record stands only for what the file says differently: the
columns of a table as rows, null for infinity, derived numbers, and of the object and the fingertips no more than the
reader needs. Its values mean what they mean where they are measured; only what does not stand there is told here.
"""

from pathlib import Path

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.errors import GraspFileError
from planner.files.json_document import as_rows, decode_json, finite_or_none
from planner.files.versioned_document import DocumentFormat, write_document
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.trial.measurement import Measurement
from sim.trial.protocol import ValidationProtocol
from sim.validation.beyond import Loads
from sim.validation.control_experiment import ControlExperiment
from sim.validation.critical_force import CriticalForce
from sim.validation.force_agreement import ForceAgreement
from sim.validation.validation import Validation
from sim.validation.verdict import Verdict

FORMAT, FORMAT_VERSION = "rhograsp.validation", 1

FILE = DocumentFormat(
    name=FORMAT,
    version=FORMAT_VERSION,
    oldest=FORMAT_VERSION,
    called="validation file",
    remedy="validate the grasp again",
)

AGREEMENT = 1e-9
"""Relative difference of two values of rho that are the same."""


class FingerRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One finger in one simulation of a `Measurement`."""

    slip: float
    spin: float = 0.0
    """0 in files of before it was measured."""
    separation: float
    predicted_force: float
    measured_force: float
    predicted_utilisation: float
    measured_utilisation: float
    loaded: bool
    lost: bool


class SimulationRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One simulation of a `Measurement`."""

    wrench: int
    """Index among the vertices of the required external force set."""
    phi: float
    """Predicted least cap for this wrench [N]."""
    cap: float
    held: bool
    slip: float
    spin: float = 0.0
    """0 in files of before it was measured."""
    translation: float
    rotation: float
    fingers: tuple[FingerRecord, ...]


class CapRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One wrench of a `CriticalForce`."""

    wrench: int
    phi: float
    lower: float
    upper: float | None
    """Null if even the highest tried slipped."""
    ratio: float | None


class CriticalForceRecord(msgspec.Struct, frozen=True, kw_only=True):
    """A `CriticalForce`: the bracket of rho, and that of every wrench."""

    lower: float
    upper: float | None
    """Null if some wrench slipped with the highest cap tried."""
    ratio: float | None
    critical_wrench: int
    wrenches: tuple[CapRecord, ...]


class ObjectRecord(msgspec.Struct, frozen=True, kw_only=True):
    """Which object was held."""

    sha256: str
    body: str

    @classmethod
    def of(cls, rigid_object: RigidObject) -> "ObjectRecord":
        """The names of one that was read."""
        return cls(sha256=rigid_object.sha256, body=rigid_object.body)


class StaticRecord(msgspec.Struct, frozen=True, kw_only=True):
    """A `StaticCheck`: where the fingertips were before anything moved."""

    distances: tuple[float, ...]
    touches: tuple[int, ...]
    tip_radius: float
    tolerance: float


class ValidationDocument(msgspec.Struct, frozen=True, kw_only=True):
    """A `Validation`, and of the grasp what tells which one it is about."""

    format: str
    format_version: int
    grasp: str | None
    """Name of the grasp file; null if the grasp came from memory."""
    object: ObjectRecord
    verdict: Verdict
    reasons: tuple[str, ...]
    rho: float
    critical_wrench: int
    strengths: tuple[float, ...] = ()
    """Of the fingers. Empty: all 1, in files of old."""
    planned_friction: tuple[float, ...]
    simulated_friction: tuple[float, ...]
    planned_torsion: tuple[float, ...] = ()
    """Torsional friction of every finger [m]. Empty: none, in files of old."""
    simulated_torsion: tuple[float, ...] = ()
    """[m]"""
    static: StaticRecord
    friction_limited: tuple[int, ...] = ()
    """Indices of the wrenches on the friction limit, held or not. Not recorded in files of old."""
    vertices: tuple[SimulationRecord, ...]
    """Empty if the static check failed."""
    forces: ForceAgreement | None
    controls: tuple[ControlExperiment, ...]
    critical_force: CriticalForceRecord | None
    beyond: tuple[Loads, ...]
    protocol: ValidationProtocol
    versions: dict[str, str]


def to_document(validation: Validation, *, grasp: str | None = None) -> ValidationDocument:
    """The validation as plain values; `grasp` names the grasp file."""
    vertices, static, held = validation.vertices, validation.static, validation.grasp
    return ValidationDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        grasp=grasp,
        object=ObjectRecord.of(held.rigid_object),
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
        vertices=_simulations(vertices, held.phi) if vertices else (),
        forces=validation.forces,
        controls=validation.controls,
        critical_force=_critical_force(validation.critical_force) if validation.critical_force else None,
        beyond=validation.beyond,
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


def read_validation(path: Path) -> ValidationDocument:
    """Read a validation file.

    Raises:
        GraspFileError: When it is missing, truncated, too large, of another format or another version.
    """
    content, _ = FILE.read(path)
    return decode_json(content, ValidationDocument, path, FILE.called)


def read_validation_of(path: Path, grasp: Grasp) -> ValidationDocument:
    """Read the validation file of one grasp.

    Raises:
        GraspFileError: When it cannot be read, or is about another object or grasp.
    """
    document = read_validation(path)
    same_object = (document.object.sha256, document.object.body) == (grasp.sha256, grasp.body)
    same_rho = abs(document.rho - grasp.rho) <= AGREEMENT * grasp.rho
    if not same_object or not same_rho or len(document.vertices) not in (0, len(grasp.phi)):
        raise GraspFileError(
            f"{path} is about another grasp (body {document.object.body!r}, rho {document.rho:.6g} N; here "
            f"{grasp.body!r}, {grasp.rho:.6g} N): validate this one, or name its own file with --validation"
        )
    return document


def _critical_force(critical: CriticalForce) -> CriticalForceRecord:
    lower, upper = critical.rho
    return CriticalForceRecord(
        lower=lower,
        upper=finite_or_none(upper),
        ratio=finite_or_none(critical.ratio),
        critical_wrench=critical.critical_wrench,
        wrenches=as_rows(
            CapRecord,
            wrench=range(len(critical.phi)),
            phi=critical.phi,
            lower=critical.lower,
            upper=critical.upper,
            ratio=critical.ratios,
        ),
    )


def _simulations(vertices: Measurement, phi: Floats) -> tuple[SimulationRecord, ...]:
    """Every wrench with the fingers that held it, and its phi, shape (wrenches,) [N]."""
    return as_rows(
        SimulationRecord,
        wrench=range(len(phi)),
        phi=phi,
        cap=vertices.caps,
        held=vertices.held,
        slip=vertices.slip,
        spin=vertices.spin,
        translation=vertices.translations,
        rotation=vertices.rotations,
        fingers=[_fingers(vertices, wrench) for wrench in range(len(phi))],
    )


def _fingers(vertices: Measurement, wrench: int) -> tuple[FingerRecord, ...]:
    return as_rows(
        FingerRecord,
        slip=vertices.slips[wrench],
        spin=vertices.spins[wrench],
        separation=vertices.separations[wrench],
        predicted_force=vertices.predicted_forces[wrench],
        measured_force=vertices.measured_forces[wrench],
        predicted_utilisation=vertices.predicted_utilisations[wrench],
        measured_utilisation=vertices.measured_utilisations[wrench],
        loaded=vertices.loaded[wrench],
        lost=vertices.lost[wrench],
    )
