"""The terminal: lines that stay on standard output, and on standard error what is being done right now.

On a terminal the latter is one line that is rewritten, elsewhere a plain line now and then. Control characters
(carriage return and blanks, nothing else) are written to terminals only. Libraries tell their progress to a plain
callback `observe(what, done, total)`; `Console.count` is one.
"""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Event, Thread
from time import perf_counter

from planner.terminal.progress import PATIENCE, Pace, progress_text

REFRESH = 0.1
"""Seconds between two rewritings on a terminal [s]."""

SELDOM = 5.0
"""Seconds between two plain lines [s]."""

BEAT = 0.5
"""Seconds between two looks at whether a plain line is due [s]."""


class Console:
    """Where a command speaks. All that it says goes through here, so that the line at the bottom can make room."""

    def __init__(self, *, quiet: bool = False, json: bool = False, clock: Callable[[], float] = perf_counter) -> None:
        """A console on the process's standard streams.

        Args:
            quiet: Say nothing but errors and what is written on purpose.
            json: Standard output is for a JSON document: words go to standard error.
            clock: Seconds that only grow [s].
        """
        self.quiet = quiet
        self._words = sys.stderr if json else sys.stdout
        self._live = not quiet and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
        self._clock = clock
        self._pace = Pace()
        self._what = ""
        self._doing, self._since = "", clock()
        self._shown = 0
        self._next = clock() + (0 if self._live else PATIENCE)

    def say(self, text: str = "") -> None:
        """Words that stay."""
        if not self.quiet:
            self.clear()
            print(text, file=self._words, flush=True)
            self._next = max(self._next, self._clock() + (0 if self._live else SELDOM))

    def write(self, text: str) -> None:
        """What was asked for, on standard output even if quiet."""
        self.clear()
        print(text, flush=True)

    def complain(self, text: str) -> None:
        """An error or a warning, on standard error even if quiet."""
        self.clear()
        print(text, file=sys.stderr, flush=True)

    @property
    def due(self) -> bool:
        """Whether what was shown is old enough for something that changes many times a second."""
        return self._clock() >= self._next

    @property
    def live(self) -> bool:
        """Whether a line is rewritten."""
        return self._live

    def show(self, text: str) -> None:
        """What is being done now: at once on terminals, elsewhere when it has taken a while, see `beat`."""
        self._doing, self._since = text, self._clock()
        self._draw(text)

    def beat(self) -> None:
        """Where nothing is rewritten: say that the work goes on, when nothing was said for a while."""
        if self._doing and not self._live and self.due:
            self._progress(f"{self._doing}, {self._clock() - self._since:.0f} s so far")

    def _draw(self, text: str) -> None:
        if self._live:
            shown = text[: _columns() - 1]
            print(f"\r{shown:<{self._shown}}", end="", file=sys.stderr, flush=True)
            self._shown = len(shown)
            self._next = self._clock() + REFRESH

    def count(self, what: str, done: float, total: float) -> None:
        """So much of the total is done; `what` names things: "grasps", "simulations (controls)"."""
        left = self._pace.left(done, total, self._clock())
        changed, self._what = what != self._what, what
        if changed:
            self._since = self._clock()
        self._doing = progress_text(what, done, total, None)
        if self.due or (self._live and changed):
            self._progress(progress_text(what, done, total, left))

    def announce(self, text: str) -> None:
        """What will take a while, at once."""
        self._progress(text)

    def clear(self) -> None:
        """Leave no trace of the line on the terminal."""
        if self._shown:
            print(f"\r{'':<{self._shown}}\r", end="", file=sys.stderr, flush=True)
            self._shown = 0

    def _progress(self, text: str) -> None:
        if self._live:
            self._draw(text)
        elif not self.quiet:
            print(f"… {text}", file=sys.stderr, flush=True)
            self._next = self._clock() + SELDOM


def _columns() -> int:
    """Width of the terminal; some do not know theirs and say 0."""
    return os.get_terminal_size(sys.stderr.fileno()).columns or 80


@contextmanager
def heartbeat(console: Console) -> Iterator[None]:
    """Let the console say that work goes on until the block ends, also where the work cannot: from another thread."""
    over = Event()

    def beat() -> None:
        while not over.wait(BEAT):
            console.beat()

    thread = Thread(target=beat, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
