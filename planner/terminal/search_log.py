"""The log of a search: lines that stay, one that is rewritten on a terminal, and JSON lines that programs follow."""

from collections.abc import Callable
from dataclasses import asdict, replace
from math import inf
from pathlib import Path
from time import perf_counter
from types import TracebackType
from typing import BinaryIO

from planner.errors import OutputError
from planner.files.json_document import encode_json
from planner.search.result import Progress, Status
from planner.terminal.console import Console
from planner.terminal.interruption import Interruption

HEADER = (
    f"{'Nodes':>10} {'Open':>8} {'LowerBound':>11} {'Incumbent':>11} {'Gap':>9} {'SOCPs':>8} {'Cuts':>6} {'Time':>8}"
)

RECORD_EVERY = 0.5
"""Least time between two JSON lines [s]."""


def row(line: Progress) -> str:
    """A line under the header."""
    incumbent = f"{line.incumbent:11.5g}" if line.incumbent < float("inf") else f"{'-':>11}"
    gap = f"{line.gap:9.2%}" if line.gap < float("inf") else f"{'-':>9}"
    return (
        f"{line.nodes:10d} {line.open:8d} {line.lower_bound:11.5g} {incumbent} {gap} "
        f"{line.socp_solves:8d} {line.cuts:6d} {line.seconds:7.2f}s"
    )


def in_words(line: Progress) -> str:
    """A line that stands alone."""
    grasp = f"best grasp {line.incumbent:.5g} N (gap {line.gap:.2%})" if line.incumbent < inf else "no grasp yet"
    return (
        f"searching: {line.nodes:,} nodes, {line.open:,} open, {grasp}, "
        f"lower bound {line.lower_bound:.5g} N, {line.seconds:.0f} s"
    )


class SearchLog:
    """Hears the search as often as it speaks, and says ever less of it; the last line is never left out."""

    def __init__(self, console: Console, file: Path | None, ending: Interruption | None = None) -> None:
        """A log.

        Args:
            console: Where the log is shown.
            ending: Told as soon as there is a grasp to keep.
            file: Where JSON lines go, if anywhere: one object per line, flushed at once, null for what is not known
                yet. The last one has the status of the search.

        Raises:
            OutputError: When the file cannot be written.
        """
        self._console, self._path, self._ending = console, file, ending or Interruption()
        self._file: BinaryIO | None = None if file is None else _opened(file)
        self._began = self._heard = perf_counter()
        self._last: Progress | None = None
        self._printed: Progress | None = None
        self._record_at = 0.0

    def header(self) -> None:
        """The head of the log; the search begins."""
        self._console.say()
        self._console.say(HEADER)
        self._console.show("searching")
        self._began = perf_counter()

    def observe(self, line: Progress) -> None:
        """What the search has to say."""
        if line.incumbent < inf:
            self._ending.keep()
        self._last, self._heard = line, perf_counter()
        last = self._printed
        due = last is None or line.incumbent < last.incumbent or line.seconds >= 2 * last.seconds + 0.5
        if due:
            self._print(line)
        if due or line.seconds >= self._record_at:
            self._record(line, None)

    def asked(self, stop: Callable[[], bool]) -> Callable[[], bool]:
        """The same question to the user, asked again and again; meanwhile the state of the search is shown as it is."""

        def question() -> bool:
            if self._console.due:
                self._console.announce(self._now())
            return stop()

        return question

    def end(self, status: Status) -> None:
        """The search has ended."""
        if self._last is not None:
            if self._last is not self._printed:
                self._print(self._last)
            self._record(self._last, status)

    def __enter__(self) -> "SearchLog":
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self._console.clear()
        if self._file is not None:
            self._file.close()

    def _now(self) -> str:
        """The last line, with the time that it is."""
        now = perf_counter()
        if self._last is None:
            return f"first grasps, {now - self._began:.1f} s"
        line = replace(self._last, seconds=self._last.seconds + now - self._heard)
        return row(line) if self._console.live else in_words(line)

    def _print(self, line: Progress) -> None:
        self._console.say(row(line))
        self._printed = line

    def _record(self, line: Progress, status: Status | None) -> None:
        self._record_at = line.seconds + RECORD_EVERY
        if self._file is not None:
            record = {**asdict(line), "gap": line.gap, "status": status}
            try:
                self._file.write(encode_json(record) + b"\n")
            except OSError as error:
                raise OutputError(f"cannot write {self._path}: {error.strerror}") from error


def _opened(path: Path) -> BinaryIO:
    try:
        return path.open("wb", buffering=0)  # what is written is there to be read, whatever happens next
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}; name a file in a folder that exists") from error
