"""What all commands share: reading the command line, exit codes, and the place where errors meet the terminal."""

import inspect
import logging
import os
import shlex
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from enum import IntEnum
from typing import TypeVar, Union

import tyro

from planner.errors import RhograspError
from planner.terminal.console import Console, heartbeat
from planner.terminal.interruption import INTERRUPTED


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


EXIT_CODES = (
    "exit codes: 0 done and proven, or verdict pass · 1 error in the input or environment · 2 usage · "
    "3 proven infeasible · 4 stopped at a limit, gap open · 5 verdict fail"
)
"""One line for every command's help."""

Options = TypeVar("Options")
Value = TypeVar("Value")

Given = Union[None, Value]  # noqa: UP007
"""An option's value, None where it is not given. To see that the default None is a `Value | None`, Tyro would load
typeguard, which brings unittest and asyncio: a twentieth of what a command imports."""


def parse(options: type[Options], program: str) -> Options:
    """The command line as a dataclass; its docstring and the exit codes are the help's first lines."""
    try:
        return tyro.cli(options, prog=program, description=f"{inspect.cleandoc(options.__doc__ or '')}\n\n{EXIT_CODES}")
    except BrokenPipeError:
        sys.exit(_unread())
    except OSError as error:
        sys.exit(_unwritable(Console(), error))


def write_json(console: Console, document: object) -> None:
    """The one document of `--json`, a line on standard output; null for numbers that are not finite."""
    from planner.files.json_document import encode_json  # here: the help must not wait for NumPy

    console.write(encode_json(document).decode())


def as_typed(program: str) -> str:
    """This process's command line, as a shell takes it; without the folder that the program was started from."""
    return shlex.join([program, *sys.argv[1:]])


def run(command: Callable[[], ExitCode], console: Console | None = None) -> None:
    """Run a command and leave with its exit code; an expected error becomes one clear line.

    Args:
        command: What to run.
        console: Where the command speaks, if it does through one.
    """
    console = console or Console()
    code: int
    with _heard_logs(console), heartbeat(console):
        try:
            code = command()
        except RhograspError as error:
            console.complain(f"error: {error}")
            code = ExitCode.ERROR
        except KeyboardInterrupt:
            code = INTERRUPTED
        except BrokenPipeError:
            code = _unread()
        except OSError as error:
            code = _unwritable(console, error)
        finally:
            console.clear()
    sys.exit(code)


def _unread() -> int:
    """Whoever read standard output, `head` for example, has seen enough: say no more, and what shells expect."""
    _say_no_more()
    return 128 + signal.SIGPIPE


def _unwritable(console: Console, error: OSError) -> int:
    """The system refuses: a full device as standard output, above all; one line, if that can be written."""
    _say_no_more()
    where = "standard output" if error.filename is None else f"'{error.filename}'"
    with suppress(OSError):
        console.complain(f"error: {where}: {error.strerror or error}")
    return ExitCode.ERROR


def _say_no_more() -> None:
    """Let what was printed and not yet written go nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


@contextmanager
def _heard_logs(console: Console) -> Iterator[None]:
    """Warnings of the libraries become lines on standard error, the project's own infos are announced."""
    handler, root = _OnScreen(console), logging.getLogger()
    ours = [logging.getLogger(package) for package in ("planner", "sim")]
    levels = [logger.level for logger in ours]
    root.addHandler(handler)
    for logger in ours:
        logger.setLevel(logging.INFO)
    try:
        yield
    finally:
        root.removeHandler(handler)
        for logger, level in zip(ours, levels, strict=True):
            logger.setLevel(level)


class _OnScreen(logging.Handler):
    """Shows what is logged."""

    def __init__(self, console: Console) -> None:
        super().__init__(logging.ERROR if console.quiet else logging.INFO)
        self._console = console

    def emit(self, record: logging.LogRecord) -> None:
        if record.levelno < logging.WARNING:
            self._console.announce(record.getMessage())
        else:
            self._console.complain(f"{record.levelname}: {record.getMessage()}")
