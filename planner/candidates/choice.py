"""From the user's word to candidates: a number, opposed pairs, a grid, the paper's points, or a file of points."""

import logging
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from planner.candidates.antipodal import antipodal_candidates
from planner.candidates.candidates import CandidateChoice, Candidates
from planner.candidates.case3 import case3_points
from planner.candidates.edges import edge_candidates, edge_grid
from planner.candidates.even import even_candidates
from planner.candidates.grid import grid_candidates
from planner.candidates.listed import ListedPoints, grasp_points, listed_candidates, read_points
from planner.errors import CandidateError
from planner.files.source_file import source_file
from planner.objects.graspable import Graspable
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.plausibility import friction_doubts, grid_doubts
from planner.objects.rigid_object import RigidObject

logger = logging.getLogger(__name__)

GRID = "grid:"
ANTIPODAL = "antipodal:"
CASE3 = "case3"
GRASP = ".json"
"""Ending of a grasp file, whose contacts are the points."""

ALLOWED = (
    "a number of points (300), antipodal:NUMBER for points in opposed pairs (antipodal:300), grid:SPACING in metres "
    "(grid:0.004), case3, or the path of a CSV file of points or of a grasp file"
)

EVEN_USUAL, PAIRS_USUAL = "300", f"{ANTIPODAL}300"
"""What is chosen unless the user says otherwise: for any number of fingers, and for two in space. Measured on mug, box,
bracket and drill with three tasks, the drill with two of them: 300 points in opposed pairs give two soft fingers about
the rho of 1,000 evenly spread ones."""


def make_candidates(
    rigid_object: Graspable,
    choice: str,
    friction: float | None = None,
    seed: int = 0,
    fingertip: float | None = None,
) -> Candidates:
    """Candidates as chosen.

    Args:
        rigid_object: The object.
        choice: `300` spreads 300 points evenly, `antipodal:300` takes 150 pairs of opposed points, `grid:0.004` lays a
            grid of 4 mm on every facet or edge, `case3` takes the paper's 217 points, anything else is the path of a
            CSV file of points, or of a grasp file (`.json`), of whose contacts the places are taken, and neither
            friction nor torsional friction.
        friction: Coulomb coefficient of all contacts; None takes each geom's own.
        seed: Of the points evenly spread or in opposed pairs in space; in the plane none is needed.
        fingertip: Radius of the ball that must fit beside other parts [m]; by default a share of the object's size.
            Points in the plane and listed points are not asked for room.

    Raises:
        CandidateError: If the choice, friction, seed or fingertip is out of range, or points are off the surface.
    """
    count = _integer(choice)
    _check_fingertip(rigid_object, fingertip, spread=count is not None or _way(choice) is not None)
    asked = CandidateChoice(
        candidates=choice, friction=friction, fingertip=fingertip, seed=seed, confirmed=False, limited=False
    )
    if not repeatable(choice):
        asked = replace(asked, file=source_file(_existing(choice)))
    if isinstance(rigid_object, PlanarObject):
        made = _planar_candidates(rigid_object, choice, count, friction)
    else:
        made = _candidates_in_space(rigid_object, asked, count)
    gridded = grid_doubts(rigid_object, _spacing(choice)) if choice.startswith(GRID) else []
    for doubt in [*gridded, *friction_doubts(made.contacts.friction)]:
        logger.warning("%s", doubt)
    return replace(made, choice=asked)


def repeatable(choice: str) -> bool:
    """Whether a choice names the same candidates of an object for ever, without a file."""
    return _integer(choice) is not None or _way(choice) is not None or choice == CASE3


def usual_choice(rigid_object: Graspable, fingers: int) -> str:
    """What is chosen where the user does not say: points in opposed pairs for two fingers in space."""
    return PAIRS_USUAL if fingers == 2 and isinstance(rigid_object, RigidObject) else EVEN_USUAL


def _candidates_in_space(rigid_object: RigidObject, asked: CandidateChoice, count: int | None) -> Candidates:
    choice, friction = asked.candidates, asked.friction
    if count is not None:
        return even_candidates(rigid_object, count, friction, asked.seed, asked.fingertip)
    if way := _way(choice):
        return way(rigid_object, asked)
    listed = ListedPoints(points=case3_points()) if choice == CASE3 else _listed(choice, 3)
    candidates = listed_candidates(rigid_object, listed.points, friction, normals=listed.normals)
    return replace(candidates, planned_torsion=listed.torsion)


def _planar_candidates(planar: PlanarObject, choice: str, count: int | None, friction: float | None) -> Candidates:
    if count is not None:
        return edge_candidates(planar, count, friction)
    if choice.startswith(GRID):
        return edge_grid(planar, _spacing(choice), friction)
    if choice == CASE3:
        raise CandidateError(f"{CASE3} lists points in space, but the object is planar; give a number or grid:SPACING")
    if choice.startswith(ANTIPODAL):
        raise CandidateError(
            "opposed pairs are chosen on objects in space; on the edges of a planar one a number of points is as good"
        )
    listed = _listed(choice, 2)
    return listed_candidates(planar, listed.points, friction, normals=listed.normals)


def _grid_in_space(rigid_object: RigidObject, asked: CandidateChoice) -> Candidates:
    return grid_candidates(rigid_object, _spacing(asked.candidates), asked.friction, asked.fingertip)


def _opposed_pairs(rigid_object: RigidObject, asked: CandidateChoice) -> Candidates:
    count = _integer(asked.candidates.removeprefix(ANTIPODAL))
    if count is None:
        raise CandidateError(f"'{asked.candidates}' names no number of points; write antipodal:300 for 150 pairs")
    made = antipodal_candidates(rigid_object, count, asked.friction, asked.seed, asked.fingertip)
    if len(made) < count:
        logger.warning(
            "%d of the %d opposed pairs asked for are all that were found: elsewhere nothing that a fingertip reaches "
            "lies opposite, within the friction cones; a number of evenly spread points covers the rest",
            len(made) // 2,
            count // 2,
        )
    return made


WAYS: dict[str, Callable[[RigidObject, CandidateChoice], Candidates]] = {
    GRID: _grid_in_space,
    ANTIPODAL: _opposed_pairs,
}
"""How points in space are chosen whose choice begins with such a word; the same ones every time."""


def _way(choice: str) -> Callable[[RigidObject, CandidateChoice], Candidates] | None:
    return next((way for word, way in WAYS.items() if choice.startswith(word)), None)


def _listed(choice: str, dimension: int) -> ListedPoints:
    """The points of a CSV file, or the contacts of a grasp file."""
    path = _existing(choice)
    return (grasp_points if path.suffix.lower() == GRASP else read_points)(path, dimension)


def _check_fingertip(rigid_object: Graspable, fingertip: float | None, *, spread: bool) -> None:
    if fingertip is None:
        return
    if not 0 <= fingertip <= rigid_object.size:
        raise CandidateError(
            f"the fingertip's radius is {fingertip} m; it must be between 0 and the object's size, "
            f"{rigid_object.size:.3g} m"
        )
    if isinstance(rigid_object, PlanarObject) or not spread:
        raise CandidateError(
            "a fingertip's radius decides where evenly spread points, opposed pairs and grids on objects in space may "
            "lie; leave --fingertip out for planar objects and listed points"
        )


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
