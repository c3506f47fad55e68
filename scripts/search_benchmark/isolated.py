"""Work in a process of its own: its peak memory is its own, and it can be stopped whatever it does."""

import multiprocessing
import resource
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

from planner.errors import RhograspError


class Answer(NamedTuple):
    """What a function returned, and the largest memory of its process."""

    value: Any

    peak_memory: int
    """Resident, with Python and its libraries [bytes]."""


def run_isolated(function: Callable[..., object], *arguments: object, limit: float) -> Answer | None:
    """Call a function in a fresh process.

    The process is forked from a server that has imported nothing: on Linux, one that the caller starts directly would
    count the caller's memory as its own.

    Args:
        function: Of a module, so that the new process finds it.
        arguments: Whatever can be pickled.
        limit: Seconds after which the process is stopped, from the moment it has imported what it needs.

    Returns:
        The answer, or None when it was not there within the limit.

    Raises:
        RhograspError: When the process ended without one.
    """
    context = multiprocessing.get_context("forkserver")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_call, args=(sender, function, arguments))
    process.start()
    sender.close()
    try:
        receiver.recv()  # it is ready
        return Answer(*receiver.recv()) if receiver.poll(limit) else None
    except EOFError as error:
        process.join()
        raise RhograspError(
            f"{function.__qualname__} ended without an answer, exit code {process.exitcode}; its message is above"
        ) from error
    finally:
        process.kill()
        process.join()
        receiver.close()


def _call(sender: Connection, function: Callable[..., object], arguments: tuple[object, ...]) -> None:
    sender.send("ready")
    value = function(*arguments)
    unit = 1 if sys.platform == "darwin" else 1024
    sender.send((value, unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss))
