"""Reads an object from whatever file describes it."""

from pathlib import Path

from planner.errors import ObjectError
from planner.objects.graspable import Graspable
from planner.objects.mjcf import read_object
from planner.objects.planar import read_planar

PLANAR = ".toml"
"""How the name of a planar object's file ends; every other file is MJCF."""


def read_object_file(path: Path, body: str | None = None) -> Graspable:
    """The object of a file.

    Args:
        path: A planar outline (`.toml`), or MJCF.
        body: Name of the body that is the object; needed when an MJCF file holds several.

    Raises:
        ObjectError: If the file holds no such object.
    """
    if path.suffix.lower() != PLANAR:
        return read_object(path, body)
    planar = read_planar(path)
    if body not in (None, planar.body):
        raise ObjectError(f"there is no body '{body}' in '{path}'; it holds one, '{planar.body}'")
    return planar
