"""Rows of measurements as CSV and Markdown."""

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path

from planner.errors import OutputError


def make_folder(path: Path) -> None:
    """Make a folder for results, with its parents, if it is not there.

    Raises:
        OutputError: When that is not possible.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {path} for the results: {error}") from error


def to_csv(rows: Sequence[Mapping[str, object]]) -> bytes:
    """Rows with the same keys, one line each under a line of keys; one row or more."""
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue().encode()


def to_markdown(rows: Sequence[Mapping[str, object]]) -> str:
    """The same as a Markdown table, numbers to five digits."""
    lines = [list(rows[0]), ["---"] * len(rows[0]), *([_cell(value) for value in row.values()] for row in rows)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _cell(value: object) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)
