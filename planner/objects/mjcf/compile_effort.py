"""What an MJCF file asks of MuJoCo's compiler, found out before it is asked."""

import io
import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import prod
from pathlib import Path
from xml.etree import ElementTree

import mujoco

from planner.errors import ObjectError
from planner.files.bounded_read import kind_of, read_bounded

MOST_ELEMENTS = 20_000
"""Elements of a file, copies counted; the time MuJoCo takes to parse them grows with the square of their number."""

MOST_XML_BYTES = 2**26
"""Largest file: room for a mesh of a million vertices written into it."""

ONE_OF_MANY = ("flexcomp", "composite")
"""Elements that stand for as many bodies as the product of their `count`."""


def require_moderate(path: Path) -> None:
    """Refuse a file that would keep the compiler busy for minutes, or waiting for ever.

    Args:
        path: The MJCF file.

    Raises:
        ObjectError: If it cannot be read, asks for too many elements, or names a file that is no regular one.
    """
    _require_utf8(path)
    _Count(main=path).add(path)
    for file in named_files(path):
        if not file.is_file():
            kind = kind_of(file.stat().st_mode)
            raise ObjectError(f"'{path}' names the file '{file}', which is {kind}; a regular file is needed")


def _require_utf8(path: Path) -> None:
    try:
        str(path).encode()
    except UnicodeEncodeError:
        raise ObjectError(
            f"the path {os.fsencode(path)!r} is not UTF-8, and MuJoCo opens no other; rename the file"
        ) from None


def named_files(path: Path) -> list[Path]:
    """The file itself and those it names, as far as they exist; itself where MuJoCo cannot tell them."""
    try:
        files = [Path(name) for name in mujoco.mju_getXMLDependencies(str(path))]
    except mujoco.FatalError:  # which its compiler will explain
        files = [path]
    return [file for file in files if file.exists()]


@dataclass(kw_only=True)
class _Count:
    """Counts the elements of a file and of what it includes."""

    main: Path
    elements: int = 0
    seen: set[Path] = field(default_factory=set)

    def add(self, path: Path, copies: int = 1) -> None:
        """Count the elements of one file, each so many times; what is no XML is left to MuJoCo."""
        self.seen.add(path)
        content = read_bounded(path, MOST_XML_BYTES, "object file", ObjectError, "; give the path of an MJCF object")
        try:
            for element, each in _multiplied(content, copies):
                self._count(element, each)
                if element.tag == "include":
                    self._include(element.get("file", ""), each)
        except (ElementTree.ParseError, ValueError, LookupError):  # LookupError: an encoding that nobody knows
            return

    def _count(self, element: ElementTree.Element, copies: int) -> None:
        copies *= _count_of(element) if element.tag in ONE_OF_MANY else 1
        self.elements += copies
        if self.elements > MOST_ELEMENTS:
            most = f"{copies:,} of them copies of one <{element.tag}>; " if copies > 1 else ""
            raise ObjectError(
                f"'{self.main}' asks MuJoCo for more than {MOST_ELEMENTS:,} elements, {most}"
                f"at most {MOST_ELEMENTS:,} are compiled: keep to those of the object"
            )

    def _include(self, name: str, copies: int) -> None:
        file = self.main.parent / name
        if os.path.lexists(file) and file not in self.seen:
            self.add(file, copies)


def _multiplied(content: bytes, copies: int) -> Iterator[tuple[ElementTree.Element, int]]:
    """Every element, in the order of the file, and how many times MuJoCo will make it."""
    each = [copies]
    for event, element in ElementTree.iterparse(io.BytesIO(content), ("start", "end")):
        if event == "end":
            each.pop()
            element.clear()
            continue
        yield element, each[-1]
        each.append(each[-1] * (_count_of(element) if element.tag == "replicate" else 1))


def _count_of(element: ElementTree.Element) -> int:
    """The product of its `count`; 1 where MuJoCo will not understand it."""
    try:
        return prod(max(int(text), 1) for text in element.get("count", "1").split())
    except ValueError:
        return 1
