"""A file that a plan was made from beside the object's: a task, limits, or a list of points."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

from planner.errors import RhograspError
from planner.files.bounded_read import read_bounded

MOST_BYTES = 100_000_000
"""Largest file: none that is read is larger."""


@dataclass(frozen=True, kw_only=True)
class SourceFile:
    """Where the file was and what it held, so that anyone can tell later whether it is still the same."""

    path: str
    """As seen from the current folder; in a grasp file, from that file's folder."""

    sha256: str
    """Digest of its content."""

    @property
    def there(self) -> bool:
        """Whether there is a file at the path now, changed or not."""
        return is_there(Path(self.path))

    @property
    def unchanged(self) -> bool:
        """Whether the file at the path is still the same."""
        now = source_file(Path(self.path))
        return now is not None and now.sha256 == self.sha256


def source_file(path: Path) -> SourceFile | None:
    """The file at a path as it is now; None for what cannot be read a second time, a pipe for example."""
    try:
        content = read_bounded(path, MOST_BYTES, "file", RhograspError)
    except RhograspError:
        return None
    return SourceFile(path=str(path), sha256=hashlib.sha256(content).hexdigest())


def is_there(path: Path) -> bool:
    """Whether a path leads to a regular file."""
    try:
        return path.is_file()
    except (OSError, ValueError):  # a path that no file can have
        return False
