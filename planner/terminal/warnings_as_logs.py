"""Warnings of the planner, collected for a report instead of interrupting it."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager


class _Collector(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage())


@contextmanager
def heard_warnings() -> Iterator[list[str]]:
    """Collect what `planner` logs as a warning in this block; nothing of it is printed meanwhile."""
    logger, collector = logging.getLogger("planner"), _Collector()
    propagated = logger.propagate
    logger.addHandler(collector)
    logger.propagate = False
    try:
        yield collector.messages
    finally:
        logger.removeHandler(collector)
        logger.propagate = propagated
