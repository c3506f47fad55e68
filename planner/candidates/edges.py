"""Candidates on the edges of a planar object; edge k runs from corner k of the outline to the next.

None lies on a corner, where no normal is defined. Corners that a fingertip cannot enter are not excluded: how thick
a fingertip is, is not known here.
"""

import numpy as np

from planner.arrays import Floats, Indices
from planner.candidates.candidates import Candidates, candidates_at
from planner.candidates.even import MOST_CANDIDATES
from planner.candidates.grid import check_spacing, too_fine
from planner.errors import CandidateError
from planner.objects.planar.planar_object import PlanarObject

SAME_GAP = 9
"""Decimals to which gaps, relative to the spacing, must agree to be equally wide."""


def edge_candidates(planar: PlanarObject, count: int, friction: float | None) -> Candidates:
    """Exactly `count` candidates at equal distances h along the perimeter.

    The first lies where all stay farthest from the corners: in the middle of the widest gap between the corners'
    positions modulo h. If h divides every edge, these are the centres of cells of length h.

    Args:
        planar: The object.
        count: 1 to MOST_CANDIDATES.
        friction: Coulomb coefficient of all contacts; None takes the object's own.

    Raises:
        CandidateError: If an argument is out of range.
    """
    if not 1 <= count <= MOST_CANDIDATES:
        raise CandidateError(f"{count} candidates were asked for; choose 1 to {MOST_CANDIDATES}")
    lengths = planar.outline.lengths
    ends = lengths.cumsum()
    spacing = ends[-1] / count
    corners = np.sort(np.concatenate([[0.0], ends[:-1]]) % spacing)
    gaps = np.diff(corners, append=corners[0] + spacing)
    widest = np.round(gaps / spacing, SAME_GAP).argmax()
    along = ((corners[widest] + gaps[widest] / 2) % spacing) + spacing * np.arange(count)
    edge = ends.searchsorted(along).clip(max=len(lengths) - 1)
    fraction = 1 - (ends[edge] - along) / lengths[edge]
    return _at(planar, edge, fraction, friction)


def edge_grid(planar: PlanarObject, spacing: float, friction: float | None) -> Candidates:
    """The centres of round(length / spacing) equal cells of every edge, edge by edge.

    Args:
        planar: The object.
        spacing: Wanted length of the cells [m].
        friction: Coulomb coefficient of all contacts; None takes the object's own.

    Raises:
        CandidateError: If the spacing is not positive or gives too many points.
    """
    check_spacing(planar, spacing)
    cells = np.maximum(1.0, np.floor(planar.outline.lengths / spacing + 0.5))
    if cells.sum() > MOST_CANDIDATES:
        raise too_fine(planar, spacing)
    edge = np.repeat(np.arange(len(cells)), cells.astype(int))
    number = np.concatenate([np.arange(int(each)) for each in cells])
    return _at(planar, edge, (number + 0.5) / cells[edge], friction)


def _at(planar: PlanarObject, edge: Indices, fraction: Floats, friction: float | None) -> Candidates:
    """Candidates at fractions of edges."""
    outline = planar.outline
    points = outline.corners[edge] + fraction[:, None] * outline.edges[edge]
    return candidates_at(planar, points, np.zeros(len(edge), dtype=int), edge, friction)
