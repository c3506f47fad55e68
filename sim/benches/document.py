"""The bench file: verdict, evidence and every setting of another group's test, as one versioned JSON document."""

from pathlib import Path

import msgspec

from planner.files.versioned_document import write_document
from sim.benches.bench import BenchOutcome
from sim.benches.settings import BenchSettings
from sim.validation.document import ObjectRecord

FORMAT, FORMAT_VERSION = "rhograsp.bench", 1


class TugRecord(msgspec.Struct, frozen=True, kw_only=True):
    """One simulation: the settings' tugs of the same number."""

    translation: float
    """Largest displacement of the body's origin at any look [m]."""
    rotation: float
    """Largest rotation at any look [rad]."""
    touching: tuple[bool, ...]
    """Which fingertips touch the object at the end."""


class BenchDocument(msgspec.Struct, frozen=True, kw_only=True):
    """The whole document."""

    format: str
    format_version: int
    grasp: str | None
    """Name of the grasp file; null if the grasp came from memory."""
    object: ObjectRecord
    passed: bool
    reasons: tuple[str, ...]
    """Why not; empty when passed."""
    squeeze: float
    """Named largest force of a fingertip before the tugs [N]."""
    preload: tuple[tuple[float, float, float], ...]
    """Constant push of each fingertip in the body frame [N]."""
    tip_radius: float
    """[m]"""
    simulations: tuple[TugRecord, ...]
    settings: BenchSettings
    """Name, world, fingers, tugs and thresholds."""
    versions: dict[str, str]
    """Versions of the packages that can change the outcome."""


def to_document(outcome: BenchOutcome, *, grasp: str | None = None) -> BenchDocument:
    """The outcome as plain values; `grasp` names the grasp file."""
    rows = zip(outcome.translations.tolist(), outcome.rotations.tolist(), outcome.touching.tolist(), strict=True)
    return BenchDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        grasp=grasp,
        object=ObjectRecord(sha256=outcome.rigid_object.sha256, body=outcome.rigid_object.body),
        passed=outcome.passed,
        reasons=outcome.reasons,
        squeeze=outcome.squeeze,
        preload=tuple((x, y, z) for x, y, z in outcome.preload.tolist()),
        tip_radius=outcome.tip_radius,
        simulations=tuple(
            TugRecord(translation=translation, rotation=rotation, touching=tuple(touching))
            for translation, rotation, touching in rows
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
