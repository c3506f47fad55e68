"""From the user's word to candidates: a number, a grid, the paper's points, or a file of points."""

from pathlib import Path

from planner.candidates.candidates import Candidates
from planner.candidates.case3 import case3_points
from planner.candidates.even import even_candidates
from planner.candidates.grid import grid_candidates
from planner.candidates.listed import listed_candidates, read_points
from planner.errors import CandidateError
from planner.objects.rigid_object import RigidObject

GRID = "grid:"
CASE3 = "case3"
ALLOWED = "a number of points (300), grid:SPACING in metres (grid:0.004), case3, or the path of a CSV file of points"


def make_candidates(rigid_object: RigidObject, choice: str, friction: float | None, seed: int) -> Candidates:
    """Candidates as chosen.

    Args:
        rigid_object: The object.
        choice: `300` spreads 300 points evenly, `grid:0.004` lays a grid of 4 mm on every facet, `case3` takes the
            paper's 217 points, anything else is the path of a CSV file of points.
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        seed: Of the evenly spread points.

    Raises:
        CandidateError: If the choice, the friction or the seed is out of range, or points are off the surface.
    """
    count = _integer(choice)
    if count is not None:
        return even_candidates(rigid_object, count, friction, seed)
    if choice.startswith(GRID):
        return grid_candidates(rigid_object, _spacing(choice), friction)
    points = case3_points() if choice == CASE3 else read_points(_existing(choice))
    return listed_candidates(rigid_object, points, friction)


def _integer(choice: str) -> int | None:
    try:
        return int(choice)
    except ValueError:
        return None


def _spacing(choice: str) -> float:
    text = choice.removeprefix(GRID)
    try:
        return float(text)
    except ValueError as error:
        raise CandidateError(f"the grid's spacing is {text!r}; write metres, for example grid:0.004") from error


def _existing(choice: str) -> Path:
    try:
        found = Path(choice).is_file()
    except (OSError, ValueError):
        found = False
    if not found:
        raise CandidateError(f"candidates {choice[:80]!r} are neither known nor a file; give {ALLOWED}")
    return Path(choice)
