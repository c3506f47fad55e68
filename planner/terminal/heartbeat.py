"""Off a terminal, long work says every few seconds that it goes on, also where it cannot speak for itself."""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, Thread

from planner.terminal.console import Console

INTERVAL = 0.5
"""Seconds between two looks at whether something is to be said [s]."""


@contextmanager
def heartbeat(console: Console) -> Iterator[None]:
    """Let the console say what is being done, from a thread of its own, until the block ends."""
    over = Event()

    def beat() -> None:
        while not over.wait(INTERVAL):
            console.beat()

    thread = Thread(target=beat, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
