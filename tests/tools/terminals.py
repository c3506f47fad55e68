"""A terminal to look at: a pseudo-terminal whose screen the tests read."""

import fcntl
import os
import pty
import struct
import sys
import termios
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

import pytest


class Terminal:
    """What a program writes to as a terminal, and what arrived there."""

    def __init__(self, columns: int) -> None:
        self._outside, inside = pty.openpty()
        fcntl.ioctl(inside, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        self.stream: TextIO = os.fdopen(inside, "w")

    def close(self) -> None:
        self.stream.close()
        os.close(self._outside)

    def arrived(self) -> str:
        """Everything since the last look; line ends as the program wrote them."""
        self.stream.write("\0")  # marks the end, so that the read need not wait for a silence
        self.stream.flush()
        received = b""
        while not received.endswith(b"\0"):
            received += os.read(self._outside, 65536)
        return received[:-1].decode().replace("\r\n", "\n")


@contextmanager
def terminal(columns: int = 80, kind: str = "xterm") -> Iterator[Terminal]:
    """A terminal so many columns wide that both standard streams lead to meanwhile."""
    opened = Terminal(columns)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TERM", kind)
        patch.setattr(sys, "stdout", opened.stream)
        patch.setattr(sys, "stderr", opened.stream)
        try:
            yield opened
        finally:
            opened.close()


def screen(written: str) -> list[str]:
    """The lines that a reader sees after carriage returns have moved the pen back."""
    lines = []
    for line in written.split("\n"):
        cells: list[str] = []
        for overwriting in line.split("\r"):
            cells[: len(overwriting)] = overwriting
        lines.append("".join(cells).rstrip())
    return lines
