"""Write a file completely or not at all, whoever else writes it and whenever this process is killed.

The content goes to a temporary name in the same folder, which then takes the place of the file in one step. A process
that is killed before leaves its temporary file behind; it holds no lock any more, by which the next writer in that
folder knows it, and removes it. Where there are no locks, as on Windows, it stays.
"""

import contextlib
import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

from planner.errors import OutputError
from planner.files.bounded_read import kind_of, reason

BEGIN, END = ".rhograsp-", ".tmp"
"""Of the names of temporary files."""

LOCKS = find_spec("fcntl") is not None
"""Whether this system has them."""


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file: a reader sees the old one or the whole new one.

    Raises:
        OutputError: When the folder is missing or cannot be written, the device is full, or the path is no file.
    """
    try:
        _require_file(path)
        _remove_orphans(path.parent)
        with _temporary(path.parent) as (descriptor, temporary):
            with os.fdopen(os.dup(descriptor), "wb") as stream:
                stream.write(content)
                stream.flush()
                os.fsync(descriptor)
            temporary.chmod(0o644)
            temporary.replace(path)
    except (OSError, ValueError) as error:  # ValueError: a path that no file can have
        raise OutputError(
            f"cannot write {path}: {reason(error)}; choose a folder that exists, is writable and has room"
        ) from error


def require_writable(path: Path) -> None:
    """Find out before long work whether its result can be written.

    Raises:
        OutputError: When the folder is missing or cannot be written, or the path is no file or too long a name.
    """
    try:
        _require_file(path)
        writable = path.parent.is_dir() and os.access(path.parent, os.W_OK)
    except (OSError, ValueError) as error:
        raise OutputError(f"cannot write {path}: {reason(error)}; choose another name") from error
    if not writable:
        raise OutputError(f"cannot write {path}: {path.parent} is not a writable folder; choose one that exists")


def _require_file(path: Path) -> None:
    """Refuse what a file must not take the place of."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return
    if not stat.S_ISREG(mode):
        raise OutputError(f"cannot write {path}: it is {kind_of(mode)}; name a file")


@contextmanager
def _temporary(folder: Path) -> Iterator[tuple[int, Path]]:
    """A temporary file, locked as long as it is written."""
    while True:
        descriptor, name = tempfile.mkstemp(dir=folder, prefix=BEGIN, suffix=END)
        with contextlib.suppress(OSError):  # no locks on this file system: nobody removes orphans there
            _lock(descriptor, wait=True)
        if os.fstat(descriptor).st_nlink:
            break
        os.close(descriptor)  # another writer took it for an orphan before it was locked
    try:
        yield descriptor, Path(name)
    finally:
        Path(name).unlink(missing_ok=True)
        os.close(descriptor)


def _remove_orphans(folder: Path) -> None:
    """Remove the temporary files of writers that are no more."""
    if not LOCKS:
        return
    for orphan in folder.glob(f"{BEGIN}*{END}"):
        with contextlib.suppress(OSError):  # a living writer's, or another user's
            descriptor = os.open(orphan, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                _lock(descriptor, wait=False)
                orphan.unlink()
            finally:
                os.close(descriptor)


def _lock(descriptor: int, *, wait: bool) -> None:
    """Take the lock of a file, until it is closed.

    Raises:
        OSError: If another has it and that is not waited for, or the file system knows no locks.
    """
    if not LOCKS:
        return
    import fcntl  # here: there is none on Windows

    fcntl.flock(descriptor, fcntl.LOCK_EX if wait else fcntl.LOCK_EX | fcntl.LOCK_NB)
