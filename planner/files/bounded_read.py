"""Reading a file that a user names: a regular one, and never more of it than a stated size."""

import os
import stat
from pathlib import Path

from planner.errors import RhograspError

CHUNK = 2**20
"""Bytes read at once."""


def read_bounded(path: Path, most_bytes: int, name: str, error: type[RhograspError], hint: str = "") -> bytes:
    """The content of a file, whatever the path leads to: a pipe does not block, a device is not read.

    Args:
        path: The file, or a link to it.
        most_bytes: Largest content that is read.
        name: What such a file is called, for the messages.
        error: Kind of error to raise.
        hint: What else a user may have meant, where there is no such file.

    Raises:
        RhograspError: Of the given kind, if there is no such file, it is none that can be read, or it is too large.
    """
    try:
        mode = path.stat().st_mode
        if not stat.S_ISREG(mode):
            raise error(f"the {name} '{path}' cannot be read: it is {kind_of(mode)}, not a regular file{hint}")
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        try:
            content = bytearray()
            while len(content) <= most_bytes and (chunk := os.read(descriptor, CHUNK)):
                content += chunk
        finally:
            os.close(descriptor)
    except (OSError, ValueError) as cause:  # ValueError: a path that no file can have
        raise error(f"the {name} '{path}' cannot be read: {reason(cause)}{hint}") from cause
    if len(content) > most_bytes:
        raise error(f"the {name} '{path}' is larger than {most_bytes} bytes, the most that is read")
    return bytes(content)


def kind_of(mode: int) -> str:
    """What something in a folder is, from its mode."""
    kinds = {stat.S_IFDIR: "a folder", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket"}
    return kinds.get(stat.S_IFMT(mode), "a device")


def reason(cause: OSError | ValueError) -> str:
    """Why something cannot be opened, without the path."""
    return (cause.strerror if isinstance(cause, OSError) else None) or str(cause)
