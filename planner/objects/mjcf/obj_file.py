"""The faces of an OBJ file, group by group: MuJoCo reads those of the first group only."""

import re
import zlib
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from zipfile import BadZipFile, ZipFile

import numpy as np

from planner.arrays import Indices
from planner.errors import ObjectError
from planner.files.bounded_read import read_bounded

MOST_BYTES = 2**30
"""Largest file: room for ten million faces."""

TAG = re.compile(rb"^[ \t]*[og](?:[ \t]|\r?$)", re.MULTILINE)
"""A line that begins an object or a group."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ObjFile:
    """What an OBJ file holds."""

    vertices: int
    """How many."""

    faces: Indices
    """Triangles of vertex numbers, those of all groups, shape (faces, 3); polygons are cut into fans."""

    groups: tuple[tuple[str, int], ...]
    """Name and number of triangles of each group that has any; the first is the one MuJoCo reads."""


def is_obj(path: Path) -> bool:
    """Whether there is such an OBJ file, on its own or in an archive."""
    return path.suffix.lower() == ".obj" and any(place.is_file() for place in (path, *path.parents))


def read_obj(path: Path) -> ObjFile | None:
    """The file, or None if it holds one group at most, which MuJoCo reads whole, or its faces cannot be understood.

    Args:
        path: An OBJ file that MuJoCo has read; one of the folders may be an archive (`part.mjz/cup.obj`).

    Raises:
        ObjectError: If it is too large.
    """
    content = _content(path)
    if len(TAG.findall(content)) < 2 and not _faces_before_tag(content):
        return None
    try:
        return _parsed(content.decode("latin-1").replace("\\\n", " "))
    except ValueError:
        return None


def _content(path: Path) -> bytes:
    archive = next((folder for folder in path.parents if folder.is_file()), None)
    if archive is None:
        return read_bounded(path, MOST_BYTES, "OBJ file", ObjectError)
    try:
        with ZipFile(archive) as entries:
            entry = entries.getinfo(path.relative_to(archive).as_posix())
            if entry.file_size > MOST_BYTES:
                raise ObjectError(f"'{path}' is larger than {MOST_BYTES} bytes, the most that is read")
            return entries.read(entry)
    except (OSError, BadZipFile, KeyError, zlib.error) as error:
        raise ObjectError(f"'{path}' cannot be read from its archive: {error}") from error


def _faces_before_tag(content: bytes) -> bool:
    tag = TAG.search(content)
    return tag is not None and re.search(rb"^[ \t]*f[ \t]", content[: tag.start()], re.MULTILINE) is not None


def _parsed(text: str) -> ObjFile:
    vertices, faces, groups = 0, [], [("unnamed", 0)]
    for line in text.splitlines():
        word, *rest = line.split() or [""]
        match word:
            case "v":
                vertices += 1
            case "o" | "g":
                groups.append((" ".join(rest) or "unnamed", 0))
            case "f":
                corners = [int(corner.split("/")[0]) for corner in rest]
                corners = [corner - 1 if corner > 0 else vertices + corner for corner in corners]
                fan = [(corners[0], *pair) for pair in pairwise(corners[1:])]
                groups[-1] = groups[-1][0], groups[-1][1] + len(fan)
                faces += fan
    triangles = np.array(faces, dtype=np.int64).reshape(-1, 3)
    if len(triangles) and (triangles.min() < 0 or triangles.max() >= vertices):
        raise ValueError("a face names a vertex that is not there")
    return ObjFile(vertices=vertices, faces=triangles, groups=tuple(group for group in groups if group[1]))
