"""The grasp file, `NAME.grasp.json`: the grasp, its forces, its bound, all candidates, and the cuts that prove it.

It is written completely or not at all. Reading checks structure and consistency and trusts no size; whether the
numbers are true is the business of `planner.verification.verify`.
"""

import os
import re
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.candidates.candidates import CandidateChoice
from planner.contacts import Contacts, wrench_dimension
from planner.errors import GraspFileError, OutputError, RhograspError
from planner.files.atomic_write import write_atomically
from planner.files.json_document import MOST_BYTES, decode_json, finite_or_none
from planner.files.source_file import SourceFile
from planner.files.versioned_document import DocumentFormat, document_text
from planner.grasps.consistency import check_agreement
from planner.grasps.document import (
    FORMAT,
    FORMAT_VERSION,
    CandidatesRecord,
    CertificateRecord,
    ContactRecord,
    GraspDocument,
    KindRecord,
    ObjectRecord,
    PlannerRecord,
    TaskRecord,
)
from planner.grasps.grasp import Certificate, Grasp
from planner.grasps.side_file import WITH_SIDE_FILE, with_side_file
from planner.objects.given_mass import GivenMass
from planner.objects.object_source import ObjectSource
from planner.search.finger_kind import FingerKind
from planner.task import Task

SUFFIX = ".grasp.json"

FILE = DocumentFormat(
    name=FORMAT,
    version=FORMAT_VERSION,
    oldest=WITH_SIDE_FILE,
    called="grasp file",
    remedy="install the rhograsp that wrote it",
)

ON_ONE_LINE = r'\[\n[^\[\]{}"]*\]|\{\n *"seconds"[^\[\]{}]*\}'
"""A vector, or a line of the search log; a line break is never part of a JSON string, so names are left alone."""


def numbered(path: Path, number: int) -> Path:
    """Where the grasp of that rank goes: X.grasp.json for the best, then X.2.grasp.json and so on."""
    if number == 1:
        return path
    stem, suffix = (path.name.removesuffix(SUFFIX), SUFFIX) if path.name.endswith(SUFFIX) else (path.stem, path.suffix)
    return path.with_name(f"{stem}.{number}{suffix}")


def write_grasp(path: Path | str, grasp: Grasp) -> GraspDocument:
    """Write a grasp.

    Args:
        path: Ends in `.json`; by convention in `.grasp.json`.
        grasp: What to write.

    Returns:
        What the file says.

    Raises:
        OutputError: When the folder cannot be written, or the file would be larger than what is read.
    """
    path = Path(path)
    document = _document(grasp, path)
    text = document_text(document, indent=2).decode()
    content = re.sub(ON_ONE_LINE, lambda row: " ".join(row.group().split()), text).encode()
    if len(content) > MOST_BYTES:
        raise OutputError(
            f"cannot write {path}: with {len(grasp.certificate.candidates)} candidates it would be larger than "
            f"{MOST_BYTES} bytes, the most that is read; plan on fewer candidates"
        )
    write_atomically(path, content)
    return document


def read_grasp(path: Path | str) -> Grasp:
    """Read a grasp file.

    Raises:
        GraspFileError: When it is missing, truncated, too large, of another format or a newer version, or when its
            parts do not fit each other.
    """
    path = Path(path)
    document = _decode(path)
    try:
        grasp = _grasp(path, document)
        check_agreement(document, grasp)
    except (RhograspError, ValueError, OverflowError) as error:  # OverflowError: a whole number of twenty digits
        raise GraspFileError(f"{path} is not a consistent grasp file: {error}; plan it again") from error
    return grasp


def _document(grasp: Grasp, path: Path) -> GraspDocument:
    """What a grasp file at that path says, which names other files relative to its folder."""
    contacts = grasp.contacts
    return GraspDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        object=_object_record(path, grasp),
        task=TaskRecord(
            name=grasp.task.name,
            preset=grasp.task.preset,
            file=_from_folder(grasp.task.file, path.parent),
            reference_point=grasp.task.reference_point.tolist(),
            wrenches=grasp.task.wrenches.tolist(),
        ),
        contacts=[
            ContactRecord(
                position=contacts.points[i].tolist(),
                normal=contacts.normals[i].tolist(),
                friction=float(contacts.friction[i]),
                geom=grasp.geoms[i],
                candidate=int(grasp.chosen[i]),
                strength=None if contacts.strengths[i] == 1 else float(contacts.strengths[i]),
                torsion=float(contacts.torsions[i]) or None,
            )
            for i in range(len(contacts))
        ],
        rho=finite_or_none(grasp.rho),
        lower_bound=grasp.lower_bound,
        gap=finite_or_none(grasp.gap),
        status=grasp.status,
        critical_wrench=grasp.critical_wrench if grasp.found else None,
        phi=grasp.phi.tolist(),
        forces=grasp.forces.tolist(),
        torques=grasp.torques.tolist() if contacts.torsions.any() else None,
        search=grasp.search,
        certificate=_certificate_record(grasp.certificate),
        proof_check=grasp.proof_check,
        planner=PlannerRecord(version=grasp.packages["rhograsp"], packages=grasp.packages, command=grasp.command),
        candidate_choice=_placed_choice(grasp.candidate_choice, lambda source: _from_folder(source, path.parent)),
    )


def _object_record(path: Path, grasp: Grasp) -> ObjectRecord:
    source, center = grasp.source, grasp.source.given.center_of_mass
    return ObjectRecord(
        mjcf=_relative(source.file, path.parent),
        sha256=grasp.sha256,
        body=grasp.body,
        mass=grasp.mass,
        center_of_mass=None if grasp.center_of_mass is None else grasp.center_of_mass.tolist(),
        given_mass=source.given.mass,
        given_center_of_mass=None if center is None else center.tolist(),
        locked_joints=list(source.locked_joints),
        keyframe=source.keyframe,
    )


def _certificate_record(certificate: Certificate) -> CertificateRecord:
    candidates = certificate.candidates
    return CertificateRecord(
        candidates=CandidatesRecord(
            positions=candidates.points.tolist(),
            normals=candidates.normals.tolist(),
            friction=candidates.friction.tolist(),
            torsion=candidates.torsions.tolist() if candidates.torsions.any() else None,
        ),
        cuts=certificate.cuts.tolist(),
        kinds=[KindRecord(**asdict(kind)) for kind in certificate.kinds],
        spacing=certificate.spacing or None,
        span=finite_or_none(certificate.span),
    )


def _relative(file: Path, folder: Path) -> str:
    """`file` as seen from `folder`; its full path where they share no root."""
    try:
        return Path(os.path.relpath(file.resolve(), folder.resolve())).as_posix()
    except ValueError:
        return file.resolve().as_posix()


def _from_folder(source: SourceFile | None, folder: Path) -> SourceFile | None:
    """A file as seen from `folder`."""
    return None if source is None else replace(source, path=_relative(Path(source.path), folder))


def _in_folder(source: SourceFile | None, folder: Path) -> SourceFile | None:
    """A file seen from `folder`, as seen from the current folder."""
    return None if source is None else replace(source, path=str(folder / source.path))


def _placed_choice(
    choice: CandidateChoice | None, place: Callable[[SourceFile | None], SourceFile | None]
) -> CandidateChoice | None:
    """A choice with its files as seen from elsewhere."""
    return None if choice is None else replace(choice, file=place(choice.file), limits=place(choice.limits))


def _decode(path: Path) -> GraspDocument:
    content, version = FILE.read(path)
    if version == WITH_SIDE_FILE:
        return with_side_file(path, content)
    return decode_json(content, GraspDocument, path, FILE.called)


def _grasp(path: Path, document: GraspDocument) -> Grasp:
    task, contacts = document.task, document.contacts
    certificate = _certificate(document.certificate)
    shape = (len(contacts), certificate.candidates.dimension)
    return Grasp(
        source=_source(path, document.object),
        sha256=document.object.sha256,
        body=document.object.body,
        mass=document.object.mass,
        task=Task(
            name=task.name,
            reference_point=np.array(task.reference_point),
            wrenches=np.array(task.wrenches),
            preset=task.preset,
            file=_in_folder(task.file, path.parent),
        ),
        contacts=Contacts(
            points=np.array([contact.position for contact in contacts], dtype=float).reshape(shape),
            normals=np.array([contact.normal for contact in contacts], dtype=float).reshape(shape),
            friction=np.array([contact.friction for contact in contacts], dtype=float),
            strength=np.array([1.0 if contact.strength is None else contact.strength for contact in contacts]),
            torsion=np.array([contact.torsion or 0.0 for contact in contacts]),
        ),
        geoms=tuple(contact.geom for contact in contacts),
        chosen=np.array([contact.candidate for contact in contacts], dtype=np.int64),
        lower_bound=document.lower_bound,
        status=document.status,
        phi=np.array(document.phi, dtype=float),
        forces=np.array(document.forces, dtype=float).reshape(len(document.phi), *shape),
        torques=_torques(document.torques, (len(document.phi), len(contacts))),
        search=document.search,
        certificate=certificate,
        proof_check=document.proof_check,
        packages=document.planner.packages,
        center_of_mass=_point(document.object.center_of_mass),
        candidate_choice=_placed_choice(document.candidate_choice, lambda source: _in_folder(source, path.parent)),
        command=document.planner.command,
    )


def _certificate(record: CertificateRecord) -> Certificate:
    candidates = Contacts(
        points=np.array(record.candidates.positions, dtype=float),
        normals=np.array(record.candidates.normals, dtype=float),
        friction=np.array(record.candidates.friction, dtype=float),
        torsion=None if record.candidates.torsion is None else np.array(record.candidates.torsion, dtype=float),
    )
    return Certificate(
        candidates=candidates,
        cuts=np.array(record.cuts, dtype=float).reshape(len(record.cuts), wrench_dimension(candidates.dimension)),
        kinds=tuple(FingerKind(**msgspec.structs.asdict(kind)) for kind in record.kinds),
        spacing=record.spacing or 0.0,
        span=np.inf if record.span is None else record.span,
    )


def _source(path: Path, record: ObjectRecord) -> ObjectSource:
    return ObjectSource(
        file=path.parent / record.mjcf,
        body=record.body,
        given=GivenMass(mass=record.given_mass, center_of_mass=_point(record.given_center_of_mass)),
        locked_joints=tuple(record.locked_joints),
        keyframe=record.keyframe,
    )


def _torques(rows: list[list[float]] | None, shape: tuple[int, int]) -> Floats:
    return np.zeros(shape) if rows is None else np.array(rows, dtype=float).reshape(shape)


def _point(coordinates: list[float] | None) -> Floats | None:
    return None if coordinates is None else np.array(coordinates, dtype=float)
