"""Reads an object from whatever file describes it."""

from pathlib import Path

from planner.errors import ObjectError
from planner.objects.given_mass import NOTHING_GIVEN, GivenMass
from planner.objects.graspable import Graspable
from planner.objects.mjcf import read_object
from planner.objects.planar import read_planar

PLANAR = ".toml"
"""How the name of a planar object's file ends; every other file is MJCF."""


def read_object_file(path: Path | str, body: str | None = None, given: GivenMass = NOTHING_GIVEN) -> Graspable:
    """The object of a file.

    Args:
        path: A planar outline (`.toml`), or MJCF.
        body: Name of the body that is the object; needed when an MJCF file holds several.
        given: Mass properties in place of the file's; a planar object has none but its file's.

    Raises:
        ObjectError: If the file holds no such object, or mass properties are given for a planar one.
    """
    path = Path(path)
    if path.suffix.lower() != PLANAR:
        return read_object(path, body, given)
    if not given.nothing:
        raise ObjectError(f"the mass of a planar object stands in its file; change it in '{path}'")
    planar = read_planar(path)
    if body not in (None, planar.body):
        raise ObjectError(f"there is no body '{body}' in '{path}'; it holds one, '{planar.body}'")
    return planar
