"""Grasp files of format version 1, whose candidates and cuts are in `NAME.grasp.npz` beside the JSON.

They are read, no longer written. A side file is a ZIP archive of NPY files; it comes from strangers, so nothing of it
is believed: sizes are bounded whatever is declared, and a header must be, letter by letter, as NumPy wrote it for
numbers of double precision.
"""

import hashlib
import io
import re
import zipfile
import zlib
from math import prod
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.errors import GraspFileError
from planner.files.bounded_read import read_bounded
from planner.files.json_document import decode_json
from planner.grasps.document import GraspDocument

WITH_SIDE_FILE = 1
"""The format version."""

MOST_BYTES = 2**26
"""Largest side file, and largest array in it: room for a million candidates."""

HEADER = re.compile(
    rb"\x93NUMPY\x01\x00..\{'descr': '<f8', 'fortran_order': (False|True), "
    rb"'shape': \((\d{1,9}),(?: (\d{1,9}))?\), \} *\n",
    re.DOTALL,
)
"""Of an NPY file of version 1.0 with a vector or matrix of doubles."""


class _Certificate(msgspec.Struct, frozen=True):
    file: str
    sha256: str
    cuts: int


class _Document(msgspec.Struct, frozen=True):
    certificate: _Certificate


def with_side_file(path: Path, content: bytes) -> GraspDocument:
    """The document with the arrays of its side file in their places.

    Args:
        path: The JSON file.
        content: Its text.

    Raises:
        GraspFileError: If either is broken, or the side file is missing or not the one this grasp was written with.
    """
    record = decode_json(content, _Document, path, "grasp file").certificate
    arrays = _read_side_file(path.parent / Path(record.file).name, record.sha256)
    if len(arrays["cuts"]) != record.cuts:
        raise GraspFileError(f"{path} states {record.cuts} cuts; its side file holds {len(arrays['cuts'])}")
    document: dict[str, Any] = decode_json(content, dict[str, Any], path, "grasp file")
    rows = {name: array.tolist() for name, array in arrays.items()}
    document["certificate"] |= {"cuts": rows.pop("cuts"), "candidates": rows}
    try:
        return msgspec.convert(document, GraspDocument)
    except msgspec.ValidationError as error:
        raise GraspFileError(f"{path} is not a grasp file: {error}") from error


def _read_side_file(path: Path, sha256: str) -> dict[str, Floats]:
    content = read_bounded(path, MOST_BYTES, "side file of the grasp, which must be beside it,", GraspFileError)
    if hashlib.sha256(content).hexdigest() != sha256:
        raise GraspFileError(f"{path} is not the side file this grasp was written with; plan the grasp again")
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return {name: _array(archive, f"{name}.npy") for name in ("positions", "normals", "friction", "cuts")}
    # What ZIP archives and their compression raise when they are broken.
    except (ValueError, LookupError, EOFError, OSError, RuntimeError, zipfile.BadZipFile, zlib.error) as error:
        raise GraspFileError(f"{path} is not a side file of a grasp: {error}") from error


def _array(archive: zipfile.ZipFile, name: str) -> Floats:
    """One array of the archive.

    Raises:
        ValueError: If it is not one, or too large.
    """
    entry = archive.getinfo(name)
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError(f"{name} is compressed in another way than NumPy does")
    with archive.open(entry) as stream:
        content = stream.read(MOST_BYTES + 1)
    header = HEADER.match(content)
    if header is None or len(content) > MOST_BYTES:
        raise ValueError(f"{name} is not a vector or matrix of doubles of at most {MOST_BYTES} bytes")
    fortran, rows, columns = header.groups()
    shape = (int(rows),) if columns is None else (int(rows), int(columns))
    if 8 * prod(shape) != len(content) - header.end():
        raise ValueError(f"{name} declares the shape {shape} and holds {len(content) - header.end()} bytes")
    values = np.frombuffer(content, dtype="<f8", offset=header.end())
    return values.reshape(shape, order="F" if fortran == b"True" else "C")
