"""Read a validation file, and know whether it is about a given grasp."""

from pathlib import Path

import msgspec

from planner.errors import GraspFileError
from planner.grasp import Grasp
from planner.grasp_document import Header
from sim.validation_file import FORMAT, FORMAT_VERSION, ValidationDocument

MAX_BYTES = 2**28
AGREEMENT = 1e-9
"""Relative difference of two values of rho that are the same."""


def read_validation(path: Path) -> ValidationDocument:
    """Read a validation file.

    Raises:
        GraspFileError: When it is missing, truncated, too large, of another format or another version.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise GraspFileError(f"cannot read {path}: {error.strerror}") from error
    if len(content) > MAX_BYTES:
        raise GraspFileError(f"{path} is larger than {MAX_BYTES} bytes: not a validation file")
    try:
        header = msgspec.json.decode(content, type=Header)
        if (header.format, header.format_version) != (FORMAT, FORMAT_VERSION):
            raise GraspFileError(
                f"{path} has format {header.format!r} version {header.format_version}; expected {FORMAT!r} version "
                f"{FORMAT_VERSION}; validate the grasp again"
            )
        return msgspec.json.decode(content, type=ValidationDocument)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise GraspFileError(f"{path} is not a validation file, or is truncated: {error}") from error


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
