"""Reading a TOML file into a struct: bounded, with every way it can fail said as an error of the caller's kind."""

import tomllib
from pathlib import Path
from typing import TypeVar

import msgspec

from planner.errors import RhograspError
from planner.files.bounded_read import read_bounded

MAX_FILE_BYTES = 1_000_000
"""Largest file: room for tens of thousands of numbers."""

T = TypeVar("T")


def read_toml(
    path: Path, struct: type[T], name: str, error: type[RhograspError], hint: str = "", sample: str = ""
) -> T:
    """The content of a TOML file.

    Args:
        path: The file.
        struct: What it must hold, a msgspec struct.
        name: What such a file is called, for the messages.
        error: Kind of error to raise.
        hint: What else a user may have meant, where there is no such file.
        sample: What ends a complaint about the content: how a file that is right can look.

    Raises:
        RhograspError: Of the given kind, if the file cannot be read, is too long, is not TOML, or does not fit.
    """
    content = read_bounded(path, MAX_FILE_BYTES, name, error, hint)
    try:
        return msgspec.convert(tomllib.loads(content.decode()), struct)
    except (ValueError, OverflowError, RecursionError, RhograspError) as cause:  # ValueError: TOML, UTF-8
        raise error(f"'{path}' is not a {name}: {cause}{sample}") from cause
