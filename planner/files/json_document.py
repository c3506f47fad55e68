"""JSON: written in one way, and read as what somebody else may have written, with one clear error for all faults.

JSON has no number that is not finite; null stands for it.
"""

from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import TypeVar

import msgspec
import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.errors import GraspFileError

MOST_BYTES = 2**26
"""Largest document: room for half a million candidates. As values it takes two dozen times the memory."""

T = TypeVar("T")

Column = Sequence[object] | Floats | Indices | Mask
"""One value for every row of a table."""


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


def encode_json(value: object) -> bytes:
    """A value on one line; NumPy's numbers are numbers."""
    return msgspec.json.encode(value, enc_hook=_plain)


def finite_or_none(value: float) -> float | None:
    """The number, or None where JSON has none for it."""
    return value if isfinite(value) else None


def as_rows(kind: type[T], **columns: Column) -> tuple[T, ...]:
    """The rows of a table as plain values, null for what is not finite.

    Args:
        kind: What a row is, made from its values by name.
        columns: By the names of the values.
    """
    lists = (column if isinstance(column, Sequence) else column.tolist() for column in columns.values())
    return tuple(
        kind(**{name: _or_null(value) for name, value in zip(columns, row, strict=True)})
        for row in zip(*lists, strict=True)
    )


def _or_null(value: object) -> object:
    return finite_or_none(value) if isinstance(value, float) else value


def _plain(value: object) -> object:
    if isinstance(value, np.generic):
        return value.item()
    raise NotImplementedError(f"a document holds no {type(value).__name__}")
