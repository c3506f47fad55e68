"""What every command's exit code means, and the one place where errors meet the terminal."""

import logging
import sys
from collections.abc import Callable
from enum import IntEnum

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


EXIT_CODES = "exit codes: " + " · ".join(
    f"{code.value} {meaning}"
    for code, meaning in zip(
        ExitCode,
        (
            "done and proven, or verdict pass",
            "error in the input or environment",
            "usage",
            "proven infeasible",
            "stopped at a limit, gap open",
            "verdict fail",
        ),
        strict=True,
    )
)
"""One line for every command's help."""


def run(command: Callable[[], ExitCode]) -> None:
    """Run a command and leave with its exit code; an expected error becomes one clear line."""
    logging.basicConfig(format="%(levelname)s: %(message)s", level=logging.WARNING)
    try:
        code = command()
    except RhograspError as error:
        print(f"error: {error}", file=sys.stderr)
        code = ExitCode.ERROR
    sys.exit(code)
