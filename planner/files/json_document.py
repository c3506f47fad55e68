"""Decoding a JSON document that somebody else may have written, with one clear error for all that can be wrong."""

from pathlib import Path
from typing import TypeVar

import msgspec

from planner.errors import GraspFileError

MOST_BYTES = 2**26
"""Largest document: room for half a million candidates. As values it takes two dozen times the memory."""

T = TypeVar("T")


class Header(msgspec.Struct, frozen=True):
    """What is read first, to tell a foreign or newer file from a broken one."""

    format: str
    format_version: int


def decode_json(content: bytes, kind: type[T], path: Path, name: str) -> T:
    """The values of a document.

    Args:
        content: Its text.
        kind: What it must hold.
        path: Where it was read, for the message.
        name: What such a file is called, for the message.

    Raises:
        GraspFileError: If it is not JSON, is truncated, nested too deeply, or does not fit.
    """
    try:
        return msgspec.json.decode(content, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise GraspFileError(f"{path} is not a {name}, or is truncated: {error}") from error
