"""What all commands share: reading the command line, exit codes, and the place where errors meet the terminal."""

import inspect
import logging
import signal
import sys
from collections.abc import Callable
from enum import IntEnum
from typing import TypeVar

import tyro

from planner.errors import RhograspError


class ExitCode(IntEnum):
    """The same for all commands; 2 is also what the argument parser uses."""

    DONE = 0
    """Done and proven, or the verdict is pass."""
    ERROR = 1
    """The input or the environment is at fault; the message says how."""
    USAGE = 2
    """The command line is wrong."""
    INFEASIBLE = 3
    """Proven: no grasp with these candidates resists the task."""
    LIMIT = 4
    """Stopped at a limit; the gap is open and stated."""
    FAILED = 5
    """The verdict is fail."""


INTERRUPTED = 128 + signal.SIGINT
"""What shells expect of a program that Ctrl-C has killed."""

EXIT_CODES = (
    "exit codes: 0 done and proven, or verdict pass · 1 error in the input or environment · 2 usage · "
    "3 proven infeasible · 4 stopped at a limit, gap open · 5 verdict fail"
)
"""One line for every command's help."""

Options = TypeVar("Options")


def parse(options: type[Options], program: str) -> Options:
    """The command line as a dataclass; its docstring and the exit codes are the help's first lines."""
    return tyro.cli(options, prog=program, description=f"{inspect.cleandoc(options.__doc__ or '')}\n\n{EXIT_CODES}")


class Interruption:
    """Turns the first Ctrl-C into a request to stop, so that work in progress is kept; the second one kills."""

    def __init__(self) -> None:
        self._requested = False
        signal.signal(signal.SIGINT, self._request)

    def __call__(self) -> bool:
        """Whether the user has asked to stop."""
        return self._requested

    def _request(self, *_: object) -> None:
        self._requested = True
        print("stopping; press Ctrl-C again to leave without a result", file=sys.stderr)
        signal.signal(signal.SIGINT, signal.default_int_handler)


def run(command: Callable[[], ExitCode]) -> None:
    """Run a command and leave with its exit code; an expected error becomes one clear line."""
    logging.basicConfig(format="%(levelname)s: %(message)s", level=logging.WARNING)
    try:
        code = command()
    except RhograspError as error:
        print(f"error: {error}", file=sys.stderr)
        code = ExitCode.ERROR
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    sys.exit(code)
