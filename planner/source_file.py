"""A file that a plan was made from beside the object's: a task, limits, or a list of points."""

import hashlib
from dataclasses import dataclass
from pathlib import Path


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
        return Path(self.path).is_file()

    @property
    def unchanged(self) -> bool:
        """Whether the file at the path is still the same."""
        now = source_file(Path(self.path))
        return now is not None and now.sha256 == self.sha256


def source_file(path: Path) -> SourceFile | None:
    """The file at a path as it is now; None for what cannot be read twice, a pipe for example."""
    if not path.is_file():
        return None
    with path.open("rb") as stream:
        return SourceFile(path=str(path), sha256=hashlib.file_digest(stream, "sha256").hexdigest())
