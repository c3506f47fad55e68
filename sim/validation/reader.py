"""Read a validation file, and know whether it is about a given grasp."""

from pathlib import Path

from planner.errors import GraspFileError
from planner.files.json_document import decode_json
from planner.files.versioned_document import DocumentFormat
from planner.grasps.grasp import Grasp
from sim.validation.document import FORMAT, FORMAT_VERSION, ValidationDocument

FILE = DocumentFormat(
    name=FORMAT,
    version=FORMAT_VERSION,
    oldest=FORMAT_VERSION,
    called="validation file",
    remedy="validate the grasp again",
)

AGREEMENT = 1e-9
"""Relative difference of two values of rho that are the same."""


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
