"""MuJoCo's compiler where it can be given up on.

It cannot be interrupted, and a small file can keep it busy for hours or ask it for any amount of memory. So the first
time a file is compiled this is rehearsed in a copy of the process, which the system ends when it takes too much. That
costs a few hundredths of a second, or as long again as a compiler takes that is busy for longer. Where a process cannot
be copied, as on Windows, there are no limits but those of `compile_effort`.
"""

import faulthandler
import os
import signal
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn, TypeVar

from planner.errors import MasslessError, ObjectError
from planner.objects.mjcf.compile_effort import named_files

MOST_SECONDS = 60.0
"""Time for one compilation [s].

A round mesh of 200,000 facets takes a few seconds. Not so one with faces of many corners: for a mesh of a cylinder the
time grows a little faster than the square of the number of sides, 3 s for 5,000 and 20 s for 10,000.
"""

MOST_BYTES = 2**32
"""Memory for one compilation; a mesh of 200,000 facets takes an eighth of it."""

DONE = "done"
"""What the copy answers when it has compiled."""

REFUSALS = {kind.__name__: kind for kind in (ObjectError, MasslessError)}
"""What it answers else, by name, with the message on the lines below."""

STANDARD_ERROR = 2
"""As a file descriptor."""

STATES = Path("/proc/self/statm")
"""Where Linux tells the size of a process; without it memory is not bounded."""

rehearsed: set[tuple[tuple[Path, int, int], ...]] = set()
"""What was compiled within the limits in this process: path, size and time of change of a file and all it names."""

T = TypeVar("T")


def compile_bounded(
    path: Path, compiled: Callable[[], T], seconds: float = MOST_SECONDS, most_bytes: int = MOST_BYTES
) -> T:
    """What a compilation gives, if it can be had within the limits.

    Args:
        path: The MJCF file.
        compiled: Compiles it, or a slight change of it.
        seconds: When to give up [s].
        most_bytes: Memory it may take beyond what this process has.

    Raises:
        ObjectError: If it takes too long or too much memory, crashes the compiler, or is refused by `compiled`.
    """
    if not hasattr(os, "fork"):
        return compiled()
    state = tuple((file.resolve(), file.stat().st_size, file.stat().st_mtime_ns) for file in named_files(path))
    if state not in rehearsed:
        _rehearse(path, compiled, seconds, most_bytes)
        rehearsed.add(state)
    with _memory(most_bytes):
        return compiled()


def _rehearse(path: Path, compiled: Callable[[], object], seconds: float, most_bytes: int) -> None:
    reader, writer = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # threads of others are not copied; none is needed
        child = os.fork()
    if child == 0:
        _work(writer, compiled, seconds, most_bytes)
    os.close(writer)
    try:
        with os.fdopen(reader, encoding="utf-8", errors="surrogateescape", newline="") as stream:
            answer = stream.read()
    finally:
        os.kill(child, signal.SIGKILL)  # it has ended, unless this wait was interrupted
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if not answer:
        raise ObjectError(_given_up(path, status, seconds, most_bytes))
    kind, _, message = answer.partition("\n")
    if kind != DONE:
        raise REFUSALS[kind](message)


def _work(writer: int, compiled: Callable[[], object], seconds: float, most_bytes: int) -> NoReturn:
    """The copy: compile, answer, end; whatever happens, it never returns into the program it is a copy of."""
    answer = DONE
    try:
        _end_me_after(seconds)
        with _memory(most_bytes):
            try:
                compiled()
            except ObjectError as refusal:
                answer = f"{type(refusal).__name__}\n{refusal}"
        os.write(writer, answer.encode("utf-8", "surrogateescape"))
    finally:
        if not isinstance(sys.exception(), MemoryError | None):
            traceback.print_exc()
        os._exit(0)


def _end_me_after(seconds: float) -> None:
    """Let the system end this process by a signal; what dying compilers say is not for the terminal."""
    import resource  # here and below: there is none on Windows

    faulthandler.disable()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM):
        signal.signal(number, signal.SIG_DFL)  # handlers would wait for the compiler
    sys.stderr = os.fdopen(os.dup(STANDARD_ERROR), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), STANDARD_ERROR)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.setitimer(signal.ITIMER_REAL, seconds)


@contextmanager
def _memory(most_bytes: int) -> Iterator[None]:
    """Meanwhile this process may grow by so much and no more."""
    if not STATES.exists():
        yield
        return
    import resource

    before, most = resource.getrlimit(resource.RLIMIT_AS)
    own = int(STATES.read_text().split()[0]) * resource.getpagesize()
    bounds = [own + most_bytes, *(limit for limit in (before, most) if limit != resource.RLIM_INFINITY)]
    resource.setrlimit(resource.RLIMIT_AS, (min(bounds), most))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (before, most))


def _given_up(path: Path, status: int, seconds: float, most_bytes: int) -> str:
    """Why there is no answer."""
    if status == -signal.SIGALRM:
        return (
            f"MuJoCo takes more than {seconds:g} s to compile '{path}' and was given up on; leave out what is not of "
            "the object, or give it fewer elements and coarser meshes; faces of thousands of corners, as the ends of a "
            "fine cylinder have, keep it busy longest"
        )
    how = f"; it was ended by {signal.Signals(-status).name}" if status < 0 else ""
    return (
        f"MuJoCo cannot compile '{path}' within {most_bytes / 2**30:g} GiB of memory{how}; give it smaller meshes and "
        "textures"
    )
