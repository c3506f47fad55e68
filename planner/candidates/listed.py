"""Candidates at points the user lists."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import msgspec
import numpy as np

from planner.arrays import Floats, Indices
from planner.candidates.candidates import Candidates, candidates_at
from planner.candidates.even import MOST_CANDIDATES
from planner.errors import CandidateError, GraspFileError
from planner.files.bounded_read import read_bounded
from planner.files.json_document import MOST_BYTES, decode_json
from planner.objects.graspable import Graspable
from planner.objects.surface.coincident import finger_parts
from planner.objects.surface.exposure import exposed
from planner.objects.surface.projection import project
from planner.objects.vectors import unit

ON_SURFACE = 1e-6
"""Largest distance of a listed point from the surface, relative to the object's size."""

PRINTED = 1e-6
"""Distance that is always allowed: contacts are printed in mm to a thousandth, off by at most half of that in each
coordinate [m]."""

NUDGE = 10
"""How far a point is moved out along its stated normal to tell which of the facets that meet there it lies on, in
tolerances."""

LARGEST_FILE = 100_000_000
"""Bytes; a million points need less."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ListedPoints:
    """Points where fingers may go, and on which of the facets that meet there, where that is stated."""

    points: Floats
    """Shape (n, d), n >= 1 [m]."""

    normals: Floats | None = None
    """Normals into the object, none of them zero, shape (n, d)."""

    torsion: float = 0.0
    """The largest torsional friction that they were planned with, where they are a grasp's contacts [m]."""


def read_points(path: Path, dimension: int = 3) -> ListedPoints:
    """Points of a CSV file: x,y,z in metres per line, an optional header line, comments after #.

    Behind each point may stand a normal into the object: x,y,z,nx,ny,nz. It decides on which facet a point of an edge
    lies.

    Args:
        path: The file.
        dimension: d: 3, or 2 in the plane.

    Raises:
        CandidateError: If the file cannot be read, is too large, empty, or a line is not d or 2 d finite numbers.
    """
    content = read_bounded(path, LARGEST_FILE, "list of points", CandidateError)
    try:
        lines = content.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        raise CandidateError(f"the points in '{path}' cannot be read: {error}") from error
    axes = ",".join("xyz"[:dimension])
    normal_axes = axes + "".join(f",n{axis}" for axis in "xyz"[:dimension])
    rows: list[tuple[float, ...]] = []
    header_allowed = True
    for number, line in enumerate(lines, start=1):
        text = line.split("#", 1)[0].strip()
        if not text:
            continue
        counts = (len(rows[0]),) if rows else (dimension, 2 * dimension)
        row, header = _numbers(text, counts), header_allowed and _is_header(text)
        header_allowed = False
        if header:
            continue
        if row is None:
            form = " or ".join(axes if count == dimension else normal_axes for count in counts)
            raise CandidateError(f"line {number} of '{path}' is {text[:80]!r}; expected finite numbers {form}")
        rows.append(row)
        if len(rows) > MOST_CANDIDATES:
            raise CandidateError(f"'{path}' lists more than {MOST_CANDIDATES} points")
    if not rows:
        raise CandidateError(f"'{path}' lists no points; write {axes} in every line, in metres")
    table = np.array(rows)
    normals = table[:, dimension:]
    if normals.size and not normals.any(axis=1).all():
        raise CandidateError(f"a normal in '{path}' is zero; it must point into the object, or be left out everywhere")
    return ListedPoints(points=table[:, :dimension], normals=normals if normals.size else None)


class _Contact(msgspec.Struct, frozen=True):
    """Of a contact in a grasp file, where it is, and how its finger resists turning."""

    position: list[float]
    normal: list[float]
    torsion: float | None = None


class _Contacts(msgspec.Struct, frozen=True):
    """Of a grasp file, the contacts."""

    contacts: list[_Contact]


def grasp_points(path: Path, dimension: int = 3) -> ListedPoints:
    """The contacts of a grasp file, of any version.

    Raises:
        GraspFileError: If it cannot be read.
        CandidateError: If it holds no contacts, or those of an object in another dimension.
    """
    content = read_bounded(path, MOST_BYTES, "grasp file", GraspFileError)
    contacts = decode_json(content, _Contacts, path, "grasp file").contacts
    sizes = {len(vector) for contact in contacts for vector in (contact.position, contact.normal)}
    if sizes != {dimension}:
        holds = f"contacts in {max(sizes)} dimensions" if contacts else "no contacts"
        raise CandidateError(f"'{path}' holds {holds}; expected contacts in {dimension} dimensions")
    return ListedPoints(
        points=np.array([contact.position for contact in contacts]),
        normals=np.array([contact.normal for contact in contacts]),
        torsion=max(contact.torsion or 0.0 for contact in contacts),
    )


def listed_candidates(
    rigid_object: Graspable,
    points: Floats,
    friction: float | None = None,
    tolerance: float = ON_SURFACE,
    normals: Floats | None = None,
) -> Candidates:
    """Candidates at the points of the surface nearest to given ones, each with the part, facet and normal it lies on.

    A point on an edge belongs to the facet whose normal is nearest to the stated one; to that with the lowest number
    where none is stated.

    Args:
        rigid_object: The object.
        points: Shape (n, d) [m].
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        tolerance: Largest distance from the surface, relative to the object's size, where that is more than PRINTED.
        normals: Into the object, of any length, shape (n, d).

    Raises:
        CandidateError: If a point is off the outer surface, or its normal points out of it; it says which one.
    """
    allowed, tie = max(tolerance * rigid_object.size, PRINTED), ON_SURFACE * 1e-3 * rigid_object.size
    stated = None if normals is None else unit(normals)
    distance, misfit = np.full(len(points), np.inf), np.full(len(points), np.inf)
    hidden = np.full(len(points), np.inf)
    part, facet = np.zeros(len(points), dtype=int), np.zeros(len(points), dtype=int)
    for index, facet_here in _nearby_facets(rigid_object, points, stated, NUDGE * allowed):
        part_here = np.full(len(points), index)
        feet, inward = project(rigid_object, points, part_here, facet_here)
        away = np.linalg.norm(points - feet, axis=1)
        outside = exposed(rigid_object, feet, inward, part_here)
        hidden = np.where(outside, hidden, np.minimum(hidden, away))
        misfit_here = away if stated is None else _misfit(rigid_object, away, allowed, stated, inward)
        better = outside & (misfit_here < misfit - tie)
        distance[better], misfit[better] = away[better], misfit_here[better]
        part[better], facet[better] = index, facet_here[better]
    _require_on_surface(rigid_object, points, distance, hidden, allowed)
    placed = candidates_at(rigid_object, points, part, facet, friction)
    if stated is not None:
        _require_inward(points, stated, placed.contacts.normals)
    return replace(placed, moved=float(np.linalg.norm(placed.contacts.points - points, axis=1).max(initial=0)))


def _nearby_facets(
    rigid_object: Graspable, points: Floats, stated: Floats | None, step: float
) -> Iterator[tuple[int, Indices]]:
    """For each part that fingers may touch the facet nearest to each point, shape (n,).

    Where normals are stated, also the facets nearest to the points after a step [m] out along them and, in the plane,
    to either side: of the facets that meet at an edge the one that faces there is then the nearest.
    """
    shifts = [np.zeros_like(points)]
    if stated is not None:
        along = [step * np.stack([-stated[:, 1], stated[:, 0]], axis=1)] if points.shape[1] == 2 else []
        shifts += [-step * stated, *(sign * side - step * stated for side in along for sign in (-1, 1))]
    for index in finger_parts(rigid_object):
        for shift in shifts:
            yield index, rigid_object.parts[index].nearest_facet(points + shift)


def _misfit(rigid_object: Graspable, away: Floats, allowed: float, stated: Floats, inward: Floats) -> Floats:
    """Orders places by the turn of their normal from the stated one; those off the surface come last, shape (n,)."""
    turn = 1 - (stated * inward).sum(axis=1)
    return np.where(away <= allowed, turn, 2 + away / rigid_object.size) * rigid_object.size


def _require_inward(points: Floats, stated: Floats, inward: Floats) -> None:
    wrong = np.flatnonzero((stated * inward).sum(axis=1) <= 0)
    if len(wrong):
        first = wrong[0]
        normal, there = (", ".join(f"{each:.3g}" for each in vector) for vector in (stated[first], inward[first] + 0.0))
        raise CandidateError(
            f"the normal ({normal}) of point {first + 1} of {len(points)} does not point into the object, whose own "
            f"there is ({there}); turn it round, or leave normals out"
        )


def _require_on_surface(
    rigid_object: Graspable, points: Floats, distance: Floats, hidden: Floats, tolerance: float
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
    touchable = "" if rigid_object.touchable.all() else f" of body '{rigid_object.body}', the only one to be touched"
    how_far = f"{distance[first]:.3g} m" if np.isfinite(distance[first]) else "far"
    raise CandidateError(
        f"{point}, lies {how_far} {'inside' if inside else 'off'} the collision surface{touchable}; "
        f"at most {tolerance:.3g} m is allowed"
    )


def _numbers(text: str, counts: tuple[int, ...]) -> tuple[float, ...] | None:
    """The finite numbers of a line, or None if they are not as many as allowed."""
    try:
        row = tuple(float(cell) for cell in text.split(","))
    except ValueError:
        return None
    return row if len(row) in counts and bool(np.isfinite(row).all()) else None


def _is_header(text: str) -> bool:
    """Whether a line holds no number at all."""
    return all(not cell.strip()[:1].isdigit() and cell.strip()[:1] not in "+-." for cell in text.split(","))
