"""Documents that state their format and its version: read with one check of both, written in one way."""

from dataclasses import dataclass
from pathlib import Path

import msgspec

from planner.errors import GraspFileError
from planner.files.atomic_write import write_atomically
from planner.files.bounded_read import read_bounded
from planner.files.json_document import MOST_BYTES, Header, decode_json, encode_json


@dataclass(frozen=True, kw_only=True)
class DocumentFormat:
    """One kind of file, as its first two keys name it."""

    name: str
    """Value of the key `format`."""

    version: int
    """Value of the key `format_version` that is written; the newest that is read."""

    oldest: int
    """The oldest version that is read."""

    called: str
    """What such a file is called, for the messages."""

    remedy: str
    """What to do about a file of a version that is not read."""

    def read(self, path: Path) -> tuple[bytes, int]:
        """Content and version of a file of this format.

        Raises:
            GraspFileError: When it is missing, truncated, too large, of another format or of a version not read.
        """
        content = read_bounded(path, MOST_BYTES, self.called, GraspFileError)
        header = decode_json(content, Header, path, self.called)
        if header.format != self.name:
            raise GraspFileError(f"{path} has format {header.format!r}; expected {self.name!r}")
        if not self.oldest <= header.format_version <= self.version:
            reads = f"{self.oldest} to {self.version}" if self.oldest < self.version else f"{self.version}"
            raise GraspFileError(
                f"{path} has format version {header.format_version}; this program reads {reads}; {self.remedy}"
            )
        return content, header.format_version


def document_text(document: msgspec.Struct, indent: int = 1) -> bytes:
    """A document as indented JSON."""
    return msgspec.json.format(encode_json(document), indent=indent) + b"\n"


def write_document(path: Path, document: msgspec.Struct) -> None:
    """Write a document: a reader sees the old file or the whole new one.

    Raises:
        OutputError: When `path` cannot be written.
    """
    write_atomically(path, document_text(document))
