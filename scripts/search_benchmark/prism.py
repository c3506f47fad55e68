"""The paper's Case III prism, its faces divided as finely as wanted. Frame: origin at the centroid, SI.

With every cell of the paper's grid divided into k x k, the legs take 9k x 5k cell centres, the hypotenuse 11k x 5k, the
bottom and the top those that keep the paper's distance from the hypotenuse. k = 1 is `planner.candidates.case3`.
"""

import numpy as np

from planner.arrays import Floats
from planner.candidates.case3 import CORNER, HALF_HEIGHT, HYPOTENUSE_CELLS, LAYERS, LEG, LEG_CELLS, UNIT
from planner.contacts import Contacts
from planner.search.problem import SearchProblem
from planner.wrench_sets.box import WrenchBox

FRICTION = 0.3
WEIGHT = 0.16
"""s g of the paper [N]."""

NEAREST_FACE = 2 * np.sqrt(2) / 3 * UNIT
"""gamma, the distance of the hypotenuse face from the centroid [m]."""


def prism_problem(contacts: Contacts, fingers: int) -> SearchProblem:
    """The paper's task on candidates of the prism: the weight along each axis, and 0.8 gamma of it as a moment."""
    moment = 0.8 * NEAREST_FACE * WEIGHT
    task = WrenchBox(force=(WEIGHT,) * 3, moment=(moment,) * 3)
    return SearchProblem(contacts=contacts, fingers=fingers, reference_point=np.zeros(3), wrenches=task.vertices())


def prism_contacts(division: int) -> Contacts:
    """Candidates on all faces, each of the paper's cells divided into `division` squared."""
    along_leg = _centers(CORNER, LEG, LEG_CELLS * division)
    along_hypotenuse = _centers(CORNER, LEG, HYPOTENUSE_CELLS * division)
    heights = _centers(-HALF_HEIGHT, 2 * HALF_HEIGHT, len(LAYERS) * division)
    first, second = np.meshgrid(np.arange(len(along_leg)), np.arange(len(along_leg)), indexing="ij")
    inside = first + second < (LEG_CELLS - 1) * division
    base = np.column_stack([along_leg[first[inside]], along_leg[second[inside]]])
    diagonal = -np.sqrt(0.5)
    faces = [
        (_wall(np.full_like(along_leg, CORNER), along_leg, heights), (1.0, 0.0, 0.0)),
        (_wall(along_leg, np.full_like(along_leg, CORNER), heights), (0.0, 1.0, 0.0)),
        (_wall(along_hypotenuse, along_hypotenuse[::-1], heights), (diagonal, diagonal, 0.0)),
        (np.column_stack([base, np.full(len(base), -HALF_HEIGHT)]), (0.0, 0.0, 1.0)),
        (np.column_stack([base, np.full(len(base), HALF_HEIGHT)]), (0.0, 0.0, -1.0)),
    ]
    points = UNIT * np.concatenate([points for points, _ in faces])
    normals = np.repeat([normal for _, normal in faces], [len(points) for points, _ in faces], axis=0)
    return Contacts(points=points, normals=normals, friction=np.full(len(points), FRICTION))


def thinned(contacts: Contacts, step: int) -> Contacts:
    """Every `step`-th candidate."""
    return contacts.subset(np.arange(0, len(contacts), step))


def _centers(start: float, length: float, cells: int) -> Floats:
    """Middles of equal cells of a segment."""
    return start + (np.arange(cells) + 0.5) * length / cells


def _wall(x: Floats, y: Floats, heights: Floats) -> Floats:
    """Points of an upright face: its outline seen from above, at every height."""
    return np.column_stack([np.tile(x, len(heights)), np.tile(y, len(heights)), np.repeat(heights, len(x))])
