"""Candidates at points the user lists."""

from pathlib import Path

import numpy as np

from planner.candidates.candidates import Candidates, candidates_at
from planner.candidates.even import MOST_CANDIDATES
from planner.errors import CandidateError
from planner.objects.coincident import covered_parts
from planner.objects.exposure import exposed
from planner.objects.graspable import Graspable
from planner.objects.projection import project
from planner.objects.rigid_object import RigidObject

ON_SURFACE = 1e-6
"""Largest distance of a listed point from the surface, relative to the object's size."""

LARGEST_FILE = 100_000_000
"""Bytes; a million points need less."""


def read_points(path: Path, dimension: int = 3) -> np.ndarray:
    """Points of a CSV file: x,y,z in metres per line, an optional header line, comments after #.

    Args:
        path: The file.
        dimension: d, numbers per line: 3, or 2 in the plane.

    Returns:
        Shape (n, d), n >= 1 [m].

    Raises:
        CandidateError: If the file cannot be read, is too large, empty, or a line is not d finite numbers.
    """
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise CandidateError(f"'{path}' is larger than {LARGEST_FILE} bytes; list fewer points")
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, ValueError) as error:
        raise CandidateError(f"the points in '{path}' cannot be read: {error}") from error
    axes = ",".join("xyz"[:dimension])
    rows: list[tuple[float, ...]] = []
    header_allowed = True
    for number, line in enumerate(lines, start=1):
        text = line.split("#", 1)[0].strip()
        if not text:
            continue
        row, header = _numbers(text, dimension), header_allowed and _is_header(text)
        header_allowed = False
        if header:
            continue
        if row is None:
            raise CandidateError(f"line {number} of '{path}' is {text[:80]!r}; expected finite numbers {axes}")
        rows.append(row)
        if len(rows) > MOST_CANDIDATES:
            raise CandidateError(f"'{path}' lists more than {MOST_CANDIDATES} points")
    if not rows:
        raise CandidateError(f"'{path}' lists no points; write {axes} in every line, in metres")
    return np.array(rows)


def listed_candidates(
    rigid_object: Graspable, points: np.ndarray, friction: float | None = None, tolerance: float = ON_SURFACE
) -> Candidates:
    """Candidates at the given points, each with the part, facet and normal it lies on.

    A point on an edge belongs to the facet with the lowest number.

    Args:
        rigid_object: The object.
        points: Shape (n, d) [m].
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        tolerance: Largest distance from the surface, relative to the object's size.

    Raises:
        CandidateError: If a point is off the outer surface; it says which one and how far.
    """
    distance = np.full(len(points), np.inf)
    hidden = np.full(len(points), np.inf)
    part, facet = np.zeros(len(points), dtype=int), np.zeros(len(points), dtype=int)
    covered = covered_parts(rigid_object) if isinstance(rigid_object, RigidObject) else {}
    for index, each in enumerate(rigid_object.parts):
        if index in covered:
            continue
        part_here, facet_here = np.full(len(points), index), each.nearest_facet(points)
        feet, normals = project(rigid_object, points, part_here, facet_here)
        away = np.linalg.norm(points - feet, axis=1)
        outside = exposed(rigid_object, feet, normals, part_here)
        hidden = np.where(outside, hidden, np.minimum(hidden, away))
        nearer = outside & (away < distance - ON_SURFACE * 1e-3 * rigid_object.size)
        distance[nearer], part[nearer], facet[nearer] = away[nearer], index, facet_here[nearer]
    _require_on_surface(rigid_object, points, distance, hidden, tolerance * rigid_object.size)
    return candidates_at(rigid_object, points, part, facet, friction)


def _require_on_surface(
    rigid_object: Graspable, points: np.ndarray, distance: np.ndarray, hidden: np.ndarray, tolerance: float
) -> None:
    off = np.flatnonzero(distance > tolerance)
    if not len(off):
        return
    first = off[0]
    position = ", ".join(f"{coordinate:.9g}" for coordinate in points[first])
    point = f"point {first + 1} of {len(points)}, ({position})"
    if hidden[first] <= tolerance:
        raise CandidateError(
            f"{point}, is on a surface no finger can reach: inside another part of the object, or in a crack "
            "between parts; move it to the outside"
        )
    inside = max(float(part.depth(points[first : first + 1])[0]) for part in rigid_object.parts) > 0
    how_far = f"{distance[first]:.3g} m" if np.isfinite(distance[first]) else "far"
    raise CandidateError(
        f"{point}, lies {how_far} {'inside' if inside else 'off'} the collision surface; "
        f"at most {tolerance:.3g} m is allowed"
    )


def _numbers(text: str, count: int) -> tuple[float, ...] | None:
    """The finite numbers of a line, or None if they are not `count`."""
    try:
        row = tuple(float(cell) for cell in text.split(","))
    except ValueError:
        return None
    return row if len(row) == count and bool(np.isfinite(row).all()) else None


def _is_header(text: str) -> bool:
    """Whether a line holds no number at all."""
    return all(not cell.strip()[:1].isdigit() and cell.strip()[:1] not in "+-." for cell in text.split(","))
