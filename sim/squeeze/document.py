"""The squeeze file: predicted and measured need of a passive squeeze with every setting, as one JSON document."""

from pathlib import Path

import msgspec

from planner.files.json_document import finite_or_none
from planner.files.versioned_document import write_document
from planner.objects.rigid_object import RigidObject
from sim.squeeze.squeeze import AGREEMENT, FORCE_TOLERANCE, SqueezeForce
from sim.trial.protocol import ValidationProtocol
from sim.validation.document import ObjectRecord

FORMAT, FORMAT_VERSION = "rhograsp.squeeze", 1


class SqueezeDocument(msgspec.Struct, frozen=True, kw_only=True):
    """A `SqueezeForce`, whose values mean what they mean there: null for what is infinite, or for what was not measured
    because no constant preload holds every wrench. A squeeze_force is not rho."""

    format: str
    format_version: int
    grasp: str | None
    """Name of the grasp file; null if the grasp came from memory."""
    object: ObjectRecord
    confirmed: bool
    rho: float
    """Predicted force cap of fingers that adapt, for comparison [N]."""
    squeeze_force: float | None
    """Predicted [N]."""
    preload: tuple[tuple[float, float, float], ...] | None
    """As predicted, in the body frame [N]."""
    measured_lower: float | None
    measured_upper: float | None
    critical_wrench: int | None
    force_tolerance: float
    """FORCE_TOLERANCE when it was measured."""
    agreement: float
    """AGREEMENT when it was measured."""
    protocol: ValidationProtocol
    versions: dict[str, str]


def to_document(squeeze: SqueezeForce, rigid_object: RigidObject, rho: float, grasp: str | None) -> SqueezeDocument:
    """The result as plain values; infinite forces become null."""
    predicted, feasible = squeeze.predicted, squeeze.predicted.feasible
    return SqueezeDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        grasp=grasp,
        object=ObjectRecord.of(rigid_object),
        confirmed=squeeze.confirmed,
        rho=rho,
        squeeze_force=predicted.squeeze_force if feasible else None,
        preload=tuple((x, y, z) for x, y, z in predicted.preload.tolist()) if feasible else None,
        measured_lower=squeeze.lower if feasible else None,
        measured_upper=finite_or_none(squeeze.upper),
        critical_wrench=squeeze.critical_wrench,
        force_tolerance=FORCE_TOLERANCE,
        agreement=AGREEMENT,
        protocol=squeeze.protocol,
        versions=squeeze.versions,
    )


def write_squeeze(
    path: Path, squeeze: SqueezeForce, rigid_object: RigidObject, *, rho: float, grasp: str | None = None
) -> None:
    """Write the document: a reader sees the old file or the whole new one.

    Args:
        path: By convention ends in `.squeeze.json`.
        squeeze: What to write.
        rigid_object: What was held.
        rho: Predicted force cap of fingers that adapt [N].
        grasp: Name of the grasp file.

    Raises:
        OutputError: When `path` cannot be written.
    """
    write_document(path, to_document(squeeze, rigid_object, rho, grasp))
