"""The bench file: verdict, evidence and every setting of another group's test, as one versioned JSON document."""

from pathlib import Path

import msgspec

from planner.files.json_document import as_rows
from planner.files.versioned_document import write_document
from sim.benches.bench import BenchOutcome
from sim.benches.settings import BenchSettings
from sim.validation.document import ObjectRecord

FORMAT, FORMAT_VERSION = "rhograsp.bench", 1


class TugRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One simulation of a `BenchOutcome`: the settings' tugs of the same number."""

    translation: float
    rotation: float
    touching: tuple[bool, ...]


class BenchDocument(msgspec.Struct, frozen=True, kw_only=True):
    """A `BenchOutcome`, whose values mean what they mean there, simulation by simulation."""

    format: str
    format_version: int
    grasp: str | None
    """Name of the grasp file; null if the grasp came from memory."""
    object: ObjectRecord
    passed: bool
    reasons: tuple[str, ...]
    squeeze: float
    preload: tuple[tuple[float, float, float], ...]
    tip_radius: float
    simulations: tuple[TugRecord, ...]
    settings: BenchSettings
    versions: dict[str, str]


def to_document(outcome: BenchOutcome, *, grasp: str | None = None) -> BenchDocument:
    """The outcome as plain values; `grasp` names the grasp file."""
    return BenchDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        grasp=grasp,
        object=ObjectRecord.of(outcome.rigid_object),
        passed=outcome.passed,
        reasons=outcome.reasons,
        squeeze=outcome.squeeze,
        preload=tuple((x, y, z) for x, y, z in outcome.preload.tolist()),
        tip_radius=outcome.tip_radius,
        simulations=as_rows(
            TugRecord,
            translation=outcome.translations,
            rotation=outcome.rotations,
            touching=[tuple(row) for row in outcome.touching.tolist()],
        ),
        settings=outcome.settings,
        versions=outcome.versions,
    )


def write_bench(path: Path, outcome: BenchOutcome, *, grasp: str | None = None) -> None:
    """Write the document: a reader sees the old file or the whole new one.

    Args:
        path: By convention ends in `.bench.json`.
        outcome: What to write.
        grasp: Name of the grasp file.

    Raises:
        OutputError: When `path` cannot be written.
    """
    write_document(path, to_document(outcome, grasp=grasp))
