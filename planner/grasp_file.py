"""The grasp file: `NAME.grasp.json`, with its large arrays in `NAME.grasp.npz` beside it.

The JSON holds the grasp, its forces and its bound; the side file holds all candidates and the cuts that prove
the bound. Both are written completely or not at all. Reading checks structure and consistency, never trusts a
size, and unpickles nothing; whether the numbers are true is the business of `planner.verification`.
"""

import hashlib
import io
import os
import re
import zipfile
from dataclasses import asdict
from pathlib import Path

import msgspec
import numpy as np

from planner.atomic_write import write_atomically
from planner.contacts import Contacts
from planner.errors import GraspFileError, RhograspError
from planner.grasp import Certificate, Grasp
from planner.grasp_agreement import check_agreement
from planner.grasp_document import (
    FORMAT,
    FORMAT_VERSION,
    CertificateRecord,
    ContactRecord,
    GraspDocument,
    Header,
    KindRecord,
    ObjectRecord,
    PlannerRecord,
    TaskRecord,
)
from planner.objects.given_mass import GivenMass
from planner.search.finger_kind import FingerKind
from planner.task import Task

SUFFIX = ".grasp.json"

MAX_JSON_BYTES = 256 * 2**20
MAX_ARRAY_BYTES = 2**30
ON_ONE_LINE = r'\[\n[^\[\]{}"]*\]|\{\n *"seconds"[^\[\]{}]*\}'
"""A vector, or a line of the search log; a line break is never part of a JSON string, so names are left alone."""


def certificate_path(path: Path) -> Path:
    """The side file of a grasp file."""
    return path.with_suffix(".npz")


def numbered(path: Path, number: int) -> Path:
    """Where the grasp of that rank goes: X.grasp.json for the best, then X.2.grasp.json and so on."""
    if number == 1:
        return path
    stem, suffix = (path.name.removesuffix(SUFFIX), SUFFIX) if path.name.endswith(SUFFIX) else (path.stem, path.suffix)
    return path.with_name(f"{stem}.{number}{suffix}")


def write_grasp(path: Path | str, grasp: Grasp) -> None:
    """Write a grasp and its side file, the side file first.

    Args:
        path: Ends in `.json`; by convention in `.grasp.json`.
        grasp: What to write.

    Raises:
        OutputError: When the folder cannot be written.
    """
    path, arrays = Path(path), io.BytesIO()
    candidates = grasp.certificate.candidates
    np.savez_compressed(
        arrays,
        positions=candidates.points,
        normals=candidates.normals,
        friction=candidates.friction,
        cuts=grasp.certificate.cuts,
    )
    document = _document(path, grasp, hashlib.sha256(arrays.getvalue()).hexdigest())
    text = msgspec.json.format(msgspec.json.encode(document), indent=2).decode()
    text = re.sub(ON_ONE_LINE, lambda row: " ".join(row.group().split()), text)
    write_atomically(certificate_path(path), arrays.getvalue())
    write_atomically(path, text.encode() + b"\n")


def read_grasp(path: Path | str) -> Grasp:
    """Read a grasp file and its side file.

    Raises:
        GraspFileError: When a file is missing, truncated, too large, of another format or a newer version, or when
            its parts do not fit each other.
    """
    path = Path(path)
    document = _decode(path)
    arrays = _read_arrays(path.parent / Path(document.certificate.file).name, document.certificate.sha256)
    try:
        grasp = _grasp(path, document, arrays)
        check_agreement(document, grasp)
    except (RhograspError, ValueError) as error:
        raise GraspFileError(f"{path} is not a consistent grasp file: {error}; plan it again") from error
    return grasp


def _document(path: Path, grasp: Grasp, arrays_sha256: str) -> GraspDocument:
    contacts, center = grasp.contacts, grasp.given.center_of_mass
    return GraspDocument(
        format=FORMAT,
        format_version=FORMAT_VERSION,
        object=ObjectRecord(
            mjcf=_relative(grasp.file, path.parent),
            sha256=grasp.sha256,
            body=grasp.body,
            mass=grasp.mass,
            given_mass=grasp.given.mass,
            given_center_of_mass=None if center is None else center.tolist(),
        ),
        task=TaskRecord(
            name=grasp.task.name,
            reference_point=grasp.task.reference_point.tolist(),
            wrenches=grasp.task.wrenches.tolist(),
        ),
        contacts=[
            ContactRecord(
                position=contacts.points[i].tolist(),
                normal=contacts.normals[i].tolist(),
                friction=float(contacts.friction[i]),
                geom=grasp.geoms[i],
                candidate=int(grasp.candidates[i]),
                strength=None if contacts.strengths[i] == 1 else float(contacts.strengths[i]),
            )
            for i in range(len(contacts))
        ],
        rho=_finite(grasp.rho),
        lower_bound=grasp.lower_bound,
        gap=_finite(grasp.gap),
        status=grasp.status,
        critical_wrench=grasp.critical_wrench if grasp.found else None,
        phi=grasp.phi.tolist(),
        forces=grasp.forces.tolist(),
        search=grasp.search,
        certificate=_certificate_record(grasp.certificate, certificate_path(path).name, arrays_sha256),
        planner=PlannerRecord(version=grasp.packages["rhograsp"], packages=grasp.packages, command=grasp.command),
        candidate_choice=grasp.candidate_choice,
    )


def _certificate_record(certificate: Certificate, file: str, sha256: str) -> CertificateRecord:
    return CertificateRecord(
        file=file,
        sha256=sha256,
        cuts=len(certificate.cuts),
        kinds=[KindRecord(**asdict(kind)) for kind in certificate.kinds],
        spacing=certificate.spacing or None,
        span=_finite(certificate.span),
    )


def _relative(file: Path, folder: Path) -> str:
    """`file` as seen from `folder`; its full path where they share no root."""
    try:
        return Path(os.path.relpath(file.resolve(), folder.resolve())).as_posix()
    except ValueError:
        return file.resolve().as_posix()


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _decode(path: Path) -> GraspDocument:
    try:
        if path.stat().st_size > MAX_JSON_BYTES:
            raise GraspFileError(f"{path} is larger than {MAX_JSON_BYTES} bytes: not a grasp file")
        content = path.read_bytes()
    except OSError as error:
        raise GraspFileError(f"cannot read {path}: {error.strerror}") from error
    try:
        header = msgspec.json.decode(content, type=Header)
        if header.format != FORMAT:
            raise GraspFileError(f"{path} has format {header.format!r}; expected {FORMAT!r}")
        if header.format_version != FORMAT_VERSION:
            raise GraspFileError(
                f"{path} has format version {header.format_version}; this program reads version {FORMAT_VERSION}; "
                "install the rhograsp that wrote it"
            )
        return msgspec.json.decode(content, type=GraspDocument)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise GraspFileError(f"{path} is not a grasp file, or is truncated: {error}") from error


def _read_arrays(path: Path, sha256: str) -> dict[str, np.ndarray]:
    """The arrays of the side file, once its digest and the sizes it declares are known to be right."""
    try:
        if path.stat().st_size > MAX_ARRAY_BYTES:
            raise GraspFileError(f"{path} is larger than {MAX_ARRAY_BYTES} bytes: not a side file of a grasp")
        content = path.read_bytes()
    except OSError as error:
        raise GraspFileError(f"cannot read the side file {path}: {error.strerror}; keep it beside the JSON") from error
    if hashlib.sha256(content).hexdigest() != sha256:
        raise GraspFileError(f"{path} is not the side file this grasp was written with; plan the grasp again")
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if sum(entry.file_size for entry in archive.infolist()) > MAX_ARRAY_BYTES:
                raise GraspFileError(f"{path} unpacks to more than {MAX_ARRAY_BYTES} bytes: not a side file of a grasp")
        with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
            return {name: arrays[name] for name in ("positions", "normals", "friction", "cuts")}
    except (ValueError, KeyError, OSError, zipfile.BadZipFile) as error:
        raise GraspFileError(f"{path} is not a side file of a grasp: {error}") from error


def _grasp(path: Path, document: GraspDocument, arrays: dict[str, np.ndarray]) -> Grasp:
    task, contacts = document.task, document.contacts
    candidates = Contacts(points=arrays["positions"], normals=arrays["normals"], friction=arrays["friction"])
    shape = (len(contacts), candidates.dimension)
    return Grasp(
        file=path.parent / document.object.mjcf,
        sha256=document.object.sha256,
        body=document.object.body,
        mass=document.object.mass,
        task=Task(name=task.name, reference_point=np.array(task.reference_point), wrenches=np.array(task.wrenches)),
        contacts=Contacts(
            points=np.array([contact.position for contact in contacts], dtype=float).reshape(shape),
            normals=np.array([contact.normal for contact in contacts], dtype=float).reshape(shape),
            friction=np.array([contact.friction for contact in contacts], dtype=float),
            strength=np.array([1.0 if contact.strength is None else contact.strength for contact in contacts]),
        ),
        geoms=tuple(contact.geom for contact in contacts),
        candidates=np.array([contact.candidate for contact in contacts], dtype=np.int64),
        lower_bound=document.lower_bound,
        status=document.status,
        phi=np.array(document.phi, dtype=float),
        forces=np.array(document.forces, dtype=float).reshape(len(document.phi), *shape),
        search=document.search,
        certificate=_certificate(document.certificate, candidates, arrays["cuts"]),
        packages=document.planner.packages,
        given=_given(document.object),
        candidate_choice=document.candidate_choice,
        command=document.planner.command,
    )


def _certificate(record: CertificateRecord, candidates: Contacts, cuts: np.ndarray) -> Certificate:
    return Certificate(
        candidates=candidates,
        cuts=cuts,
        kinds=tuple(FingerKind(**msgspec.structs.asdict(kind)) for kind in record.kinds),
        spacing=record.spacing or 0.0,
        span=np.inf if record.span is None else record.span,
    )


def _given(record: ObjectRecord) -> GivenMass:
    center = record.given_center_of_mass
    return GivenMass(mass=record.given_mass, center_of_mass=None if center is None else np.array(center))
