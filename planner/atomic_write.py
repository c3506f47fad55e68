"""Write a file completely or not at all."""

import os
import tempfile
from pathlib import Path

from planner.errors import OutputError


def write_atomically(path: Path, content: bytes) -> None:
    """Write to a temporary name in the same folder, then replace: a reader never sees half a file.

    Raises:
        OutputError: When the folder is missing or cannot be written.
    """
    try:
        descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    except OSError as error:
        raise OutputError(
            f"cannot write {path}: {error.strerror}; choose a folder that exists and is writable"
        ) from error
    temporary = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        temporary.chmod(0o644)
        temporary.replace(path)
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error
    finally:
        temporary.unlink(missing_ok=True)


def require_writable(path: Path) -> None:
    """Find out before long work whether its result can be written.

    Raises:
        OutputError: When the folder is missing or cannot be written, or the path is a folder.
    """
    if path.is_dir():
        raise OutputError(f"cannot write {path}: it is a folder; name a file")
    if not path.parent.is_dir() or not os.access(path.parent, os.W_OK):
        raise OutputError(f"cannot write {path}: {path.parent} is not a writable folder; choose one that exists")
