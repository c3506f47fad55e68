"""What ends a command early: Ctrl-C, SIGTERM, and the end of its time. One answer to all three.

While there is nothing to keep, the process ends at once, with one line. Once there is something to keep, the first of
them is a request to end with what there is, which work that takes long asks for (`Interruption` is that question), and
another Ctrl-C or SIGTERM ends at once.

A thread of its own answers, woken through `signal.set_wakeup_fd`: an exception raised in the middle of an import, a
compiled loop or MuJoCo is lost there or becomes a traceback, and a handler would have to wait for long calls of those
that do not hold the interpreter's lock.
"""

import os
import signal
import threading
from time import perf_counter

STANDARD_ERROR = 2
"""As a file descriptor."""

INTERRUPTED = 128 + signal.SIGINT
"""Exit code: what shells expect of a program that Ctrl-C has killed."""

OUT_OF_TIME = 4
"""Exit code: stopped at a limit."""

GRACE = 0.2
"""Time after the limit for work that is about to return what it has [s]; half a second is promised, and a busy machine
is late."""

STOPPING = "stopping; press Ctrl-C again to leave without a result"
NOTHING_KEPT = "interrupted; nothing is written"
NOT_YET = "no grasp found yet; allow more time than {limit:g} s (--time-limit). Nothing is written"


class Interruption:
    """Whether this process has to end with what there is; one for each process."""

    def __init__(self) -> None:
        self._requested = self._keeps = False
        self._deadline = float("inf")
        self._waiting: threading.Timer | None = None

    def __call__(self) -> bool:
        """Whether to end: the user has asked for it, or the time is over."""
        return self._requested or self.left <= 0

    def asked(self) -> bool:
        """Whether the user has asked for it."""
        return self._requested

    @property
    def left(self) -> float:
        """Time left, never below zero [s]."""
        return max(0.0, self._deadline - perf_counter())

    def keep(self) -> None:
        """From now on there is something to keep."""
        self._keeps = True

    def start_clock(self, limit: float) -> None:
        """The time limit [s] begins now; it ends a process only where signals are watched."""
        self._deadline = perf_counter() + limit
        if limit <= threading.TIMEOUT_MAX and _watched is self:
            self._waiting = threading.Timer(limit + GRACE, self._time_is_over, [limit])
            self._waiting.daemon = True
            self._waiting.start()

    def _time_is_over(self, limit: float) -> None:
        if not self._keeps:
            _leave(NOT_YET.format(limit=limit), OUT_OF_TIME)

    def _listen(self, signals: int) -> None:
        while os.read(signals, 1):
            if self._requested or not self._keeps:
                _leave("" if self._requested else NOTHING_KEPT, INTERRUPTED)
            self._requested = True
            _write(STOPPING)


_watched: Interruption | None = None
"""That of this process, once its signals are watched."""


def interruption() -> Interruption:
    """That of this process; where nobody watches signals, in tests and scripts, one that only knows the time."""
    return _watched or Interruption()


def watch_signals() -> None:
    """Answer SIGINT and SIGTERM from now on; to be called first in a process, before anything heavy is imported."""
    global _watched
    _watched = Interruption()
    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
    threading.Thread(target=_watched._listen, args=[reading], daemon=True).start()
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, lambda *_: None)  # the thread answers


def signals_as_exceptions() -> None:
    """From now on both raise KeyboardInterrupt, for a command that is ended by them as a rule."""
    signal.set_wakeup_fd(-1)
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, signal.default_int_handler)


def ignore_signals() -> None:
    """The command is over and has said so: nothing that comes now changes its exit code."""
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, signal.SIG_IGN)


def _leave(line: str, code: int) -> None:
    """End this process from any thread, at once."""
    if line:
        _write(line)
    os._exit(code)


def _write(line: str) -> None:
    """A line on standard error, below what stands there; the streams of Python may be in use."""
    below = "\n" if os.isatty(STANDARD_ERROR) else ""
    os.write(STANDARD_ERROR, f"{below}{line}\n".encode())
