"""Reads one planar object from a TOML file:

format = "rhograsp.planar"
name = "plate"
mass = 0.05          # [kg]
friction = 0.3       # of every edge, where the command line gives none
thickness = 0.01     # [m]; only the simulator uses it; a tenth of the diagonal where left out
outline = [          # corners in order, in the body frame [m]
    [0.00, 0.00],
    [0.08, 0.00],
    [0.00, 0.06],
]
"""

import logging
from pathlib import Path
from typing import Literal

import msgspec
import numpy as np

from planner.errors import ObjectError
from planner.files.toml_file import read_toml
from planner.objects.digest import digest
from planner.objects.planar.outline import Outline
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.planar.simple_polygon import LARGEST, simple_polygon
from planner.objects.plausibility import size_doubts

logger = logging.getLogger(__name__)

THICKNESS = 0.1
"""Thickness where none is given, relative to the diagonal of the outline's bounding box."""


class PlanarFile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The file, before its numbers are checked."""

    format: Literal["rhograsp.planar"]
    name: str
    outline: list[tuple[float, float]]
    mass: float
    friction: float
    thickness: float | None = None


def read_planar(path: Path) -> PlanarObject:
    """The planar object of a TOML file.

    Raises:
        ObjectError: If the file cannot be read, is of another format, its outline is no simple polygon, or a size
            is not positive.
    """
    file = read_toml(path, PlanarFile, "planar object", ObjectError)
    try:
        corners = np.array(file.outline, dtype=float).reshape(-1, 2)
        outline = Outline(
            geom=file.name,
            friction=_positive("friction", file.friction),
            corners=simple_polygon(corners, file.name),
        )
        diagonal = float(np.linalg.norm(np.ptp(corners, axis=0)))
        planar = PlanarObject(
            file=path,
            sha256=digest(path.parent, [path]),
            body=file.name,
            outline=outline,
            mass=_positive("mass", file.mass),
            thickness=_positive("thickness", THICKNESS * diagonal if file.thickness is None else file.thickness),
        )
    except ObjectError as error:
        raise ObjectError(f"planar object '{path}': {error}") from error
    for doubt in size_doubts(planar):
        logger.warning("%s", doubt)
    return planar


def _positive(name: str, value: float) -> float:
    if not 0 < value <= LARGEST:
        raise ObjectError(f"{name} is {value}; it must be positive and finite, at most {LARGEST:g}")
    return value
