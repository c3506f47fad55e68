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
from pathlib import Path

import msgspec
import numpy as np

from planner.atomic_write import write_atomically
from planner.contacts import Contacts, wrench_dimension
from planner.errors import GraspFileError, RhograspError
from planner.grasp import Certificate, Grasp
from planner.grasp_document import (
    FORMAT,
    FORMAT_VERSION,
    CertificateRecord,
    ContactRecord,
    GraspDocument,
    Header,
    ObjectRecord,
    PlannerRecord,
    TaskRecord,
)
from planner.objects.given_mass import GivenMass
from planner.search.problem import MOST_FINGERS
from planner.search.result import relative_gap
from planner.task import Task

SUFFIX = ".grasp.json"

MAX_JSON_BYTES = 256 * 2**20
MAX_ARRAY_BYTES = 2**30
AGREEMENT = 1e-6
"""Relative accuracy to which numbers stored twice must agree."""


def certificate_path(path: Path) -> Path:
    """The side file of a grasp file."""
    return path.with_suffix(".npz")


def write_grasp(path: Path, grasp: Grasp) -> None:
    """Write a grasp and its side file, the side file first.

    Args:
        path: Ends in `.json`; by convention in `.grasp.json`.
        grasp: What to write.

    Raises:
        OutputError: When the folder cannot be written.
    """
    arrays = io.BytesIO()
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
    text = re.sub(r"\[[^\[\]{}\"]*\]", lambda row: " ".join(row.group().split()), text)  # a vector stays on one line
    write_atomically(certificate_path(path), arrays.getvalue())
    write_atomically(path, text.encode() + b"\n")


def read_grasp(path: Path) -> Grasp:
    """Read a grasp file and its side file.

    Raises:
        GraspFileError: When a file is missing, truncated, too large, of another format or a newer version, or when
            its parts do not fit each other.
    """
    document = _decode(path)
    arrays = _read_arrays(path.parent / Path(document.certificate.file).name, document.certificate.sha256)
    try:
        grasp = _grasp(path, document, arrays)
        _check(document, grasp)
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
        certificate=CertificateRecord(
            file=certificate_path(path).name, sha256=arrays_sha256, cuts=len(grasp.certificate.cuts)
        ),
        planner=PlannerRecord(version=grasp.packages["rhograsp"], packages=grasp.packages),
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
        ),
        geoms=tuple(contact.geom for contact in contacts),
        candidates=np.array([contact.candidate for contact in contacts], dtype=np.int64),
        lower_bound=document.lower_bound,
        status=document.status,
        phi=np.array(document.phi, dtype=float),
        forces=np.array(document.forces, dtype=float).reshape(len(document.phi), *shape),
        search=document.search,
        certificate=Certificate(candidates=candidates, cuts=arrays["cuts"]),
        packages=document.planner.packages,
        given=_given(document.object),
    )


def _given(record: ObjectRecord) -> GivenMass:
    center = record.given_center_of_mass
    return GivenMass(mass=record.given_mass, center_of_mass=None if center is None else np.array(center))


def _check(document: GraspDocument, grasp: Grasp) -> None:
    """Raise GraspFileError where numbers that the file states twice disagree."""
    size = wrench_dimension(grasp.certificate.candidates.dimension)
    if grasp.task.wrenches.shape[1] != size or grasp.certificate.cuts.shape != (document.certificate.cuts, size):
        raise GraspFileError(f"wrenches and cuts must have {size} numbers each")
    if not np.isfinite(grasp.certificate.cuts).all():
        raise GraspFileError("a cut is not finite")
    if not 1 <= grasp.search.fingers <= min(MOST_FINGERS, len(grasp.certificate.candidates)):
        raise GraspFileError(f"{grasp.search.fingers} fingers for {len(grasp.certificate.candidates)} candidates")
    if not grasp.found:
        if document.rho is not None or len(grasp.phi):
            raise GraspFileError("rho and phi are given without contacts")
        return
    if len(grasp.contacts) != grasp.search.fingers or len(grasp.phi) != len(grasp.task.wrenches):
        raise GraspFileError(
            f"{len(grasp.contacts)} contacts for {grasp.search.fingers} fingers, "
            f"{len(grasp.phi)} values of phi for {len(grasp.task.wrenches)} wrenches"
        )
    if grasp.candidates.max() >= len(grasp.certificate.candidates) or len(set(grasp.candidates.tolist())) < len(
        grasp.candidates
    ):
        raise GraspFileError(f"contacts name candidates {grasp.candidates.tolist()}, repeated or out of range")
    _agree("position", grasp.contacts.points, grasp.certificate.candidates.points[grasp.candidates])
    _agree("phi", grasp.phi, np.linalg.norm(grasp.forces, axis=2).max(axis=1))
    _agree("rho", np.array(document.rho, dtype=float), grasp.phi.max())
    _agree("gap", np.array(document.gap, dtype=float), np.array(relative_gap(grasp.rho, grasp.lower_bound)))
    if document.critical_wrench != grasp.critical_wrench:
        raise GraspFileError(
            f"critical_wrench is {document.critical_wrench}; phi is largest at {grasp.critical_wrench}"
        )


def _agree(name: str, stated: np.ndarray, derived: np.ndarray) -> None:
    difference = np.abs(stated - derived).max()
    if not difference <= AGREEMENT * max(1.0 if name == "gap" else 0.0, float(np.abs(derived).max())):
        raise GraspFileError(f"{name} does not agree with the rest of the file (off by {difference:.3g}): edited?")
