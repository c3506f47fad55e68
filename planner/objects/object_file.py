"""Reads an object from whatever file describes it."""

from pathlib import Path

from planner.errors import ObjectError
from planner.objects.graspable import Graspable
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from planner.objects.planar.reader import read_planar

PLANAR = ".toml"
"""How the name of a planar object's file ends; every other file is MJCF."""


def read_object_file(source: ObjectSource | Path | str) -> Graspable:
    """The object of a file.

    Args:
        source: The path of a planar outline (`.toml`) or of an MJCF file that holds one object, or how else it is read.
            A planar object has no mass but its file's, and no joints.

    Raises:
        ObjectError: If the file holds no such object, or mass properties or joints are given for a planar one.
    """
    source = source if isinstance(source, ObjectSource) else ObjectSource(file=Path(source))
    path = source.file
    if path.suffix.lower() != PLANAR:
        return read_object(source)
    if not source.given.nothing:
        raise ObjectError(f"the mass of a planar object stands in its file; change it in '{path}'")
    if source.locked_joints:
        raise ObjectError(f"a planar object has no joints; leave --lock-joints out for '{path}'")
    planar = read_planar(path)
    if source.body not in (None, planar.body):
        raise ObjectError(f"there is no body '{source.body}' in '{path}'; it holds one, '{planar.body}'")
    return planar
