"""The search asks no more of a tree than it says: one of patches, the halved edges of an outline, serves it as well."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.objects.object_file import read_object_file
from planner.objects.planar.planar_object import PlanarObject
from planner.search.certified import CertifiedSearch
from planner.search.constraints.spacing import Spacing
from planner.search.cuts import CutTable
from planner.search.evaluation import Evaluator
from planner.search.exhaustive import exhaustive_search
from planner.search.node_bounds import NodeBounds
from planner.search.problem import SearchProblem
from planner.search.regions.region_tree import RegionTree
from planner.search.regions.rows import BoundedRows, Frontier, split
from planner.task import make_task
from tests.tools.commands import ASSETS

SPAN = 0.078
"""Shorter than the best pair of contacts on the convex outline, which are 80 mm apart [m]."""
CASES = [("convex", 2, np.inf), ("concave", 2, np.inf), ("convex", 3, np.inf)]


def along_the_edges(name: str, fingers: int, shares: Floats, span: float = np.inf) -> SearchProblem:
    """Contacts with friction 0.3 at these shares of every edge, edge by edge, its ends with its own normal."""
    planar = read_object_file(ASSETS / "planar" / f"{name}.toml")
    assert isinstance(planar, PlanarObject)
    outline, task = planar.outline, make_task("paper", planar)
    points = outline.corners[:, None] + shares[:, None] * outline.edges[:, None]
    inward = -np.repeat(outline.normals, len(shares), axis=0)
    return SearchProblem(
        contacts=Contacts(points=points.reshape(-1, 2), normals=inward, friction=np.full(len(inward), 0.3)),
        fingers=fingers,
        reference_point=task.reference_point,
        wrenches=task.wrenches,
        span=span,
    )


def ends(halvings: int) -> Floats:
    """Where the pieces of an edge begin and end."""
    return np.linspace(0, 1, 2**halvings + 1)


def halved_edges(problem: SearchProblem, halvings: int) -> RegionTree:
    """Patches that lie between two neighbouring contacts of an edge; unions of them above, the two contacts below."""
    contacts = np.arange(len(problem.contacts)).reshape(-1, 2**halvings + 1)
    regions, left = [np.stack([contacts[:, :-1], contacts[:, 1:]], axis=2).ravel()], []
    for below in regions:  # grows
        left.append(len(regions) if len(below) > 1 else -1)
        half = max(1, len(below) // 4 * 2)
        regions += [below[:half], below[half:]] if len(below) > 1 else []
    counts = np.array([len(below) for below in regions])
    return RegionTree(
        order=np.arange(len(problem.contacts)),
        left=np.array(left),
        contact=np.array([below[0] for below in regions]),
        sizes=np.where(counts > 1, problem.fingers, 1),
        diameters=np.where(counts > 2, counts, 0.0),
        first_row=np.zeros(problem.fingers, dtype=np.int64),
    )


def searched(problem: SearchProblem, tree: RegionTree) -> tuple[float, float]:
    """Lower bound on rho of every choice of contacts on the patches, and the best rho found at corners [N].

    Rows are split until a cut prunes them or no region has any width; then their corners are evaluated for new cuts.
    """
    start, evaluator, cases = CertifiedSearch().run(problem), Evaluator(problem), range(problem.cases)
    cuts, spacing, best = CutTable(problem), Spacing(problem, tree), start.rho
    done: list[BoundedRows] = []
    for direction in start.cuts:
        cuts.add(direction)
    bounds, frontier = NodeBounds(tree, cuts), Frontier(problem.fingers)
    frontier.push(BoundedRows.unbounded(tree.first_row[None]))
    while len(frontier):
        rows = frontier.pop(128)
        rows = rows[spacing.possible(rows.nodes)]
        narrow = (tree.diameters[rows.nodes] == 0).all(axis=1)
        for nodes in rows.nodes[narrow]:
            subset = tree.contact[tree.left[nodes] + np.arange(problem.fingers) % 2]
            phi, direction = max((evaluator.solve(subset, case)[1:] for case in cases), key=lambda solved: solved[0])
            cuts.add(direction)
            best = min(best, phi if spacing.admits(subset[None])[0] else np.inf)
        bounds.extend()
        rows = bounds.bound(rows, 1 / best)
        settled = narrow | (rows.bounds <= 1 / best)
        done.append(rows[settled])
        if not settled.all():
            frontier.push(split(rows[~settled], tree))
    weakest = max(bounds.bound(rows, 0.0).bounds.max(initial=0.0) for rows in done)
    return 1 / weakest, best


@cache
def between_the_corners(name: str, fingers: int, span: float) -> float:
    """The smallest rho of all choices among other contacts of the edges, by enumeration [N]."""
    places = {2: 7, 3: 5}[fingers]
    best = exhaustive_search(along_the_edges(name, fingers, (np.arange(places) + 0.5) / places, span))
    assert best is not None
    return best.rho


@pytest.mark.parametrize(("name", "fingers", "span"), [*CASES, ("convex", 2, SPAN)])
def test_a_search_over_patches_bounds_every_contact_on_them(name: str, fingers: int, span: float) -> None:
    """And each halving leaves less open, by a factor."""
    gaps = []
    for halvings in (1, 2, 3):
        problem = along_the_edges(name, fingers, ends(halvings), span)
        lower, best = searched(problem, halved_edges(problem, halvings))
        assert lower <= min(between_the_corners(name, fingers, span), best)
        gaps.append(best / lower - 1)
    assert gaps[1] < 0.7 * gaps[0] and gaps[2] < 0.7 * gaps[1]


@pytest.mark.parametrize(("name", "fingers", "span"), CASES)
def test_patches_bounded_at_one_end_alone_are_refuted_by_enumeration(name: str, fingers: int, span: float) -> None:
    """So the corners are needed, and the enumeration can tell."""
    problem = along_the_edges(name, fingers, ends(2), span)
    tree = halved_edges(problem, 2)
    contact, ends_of = tree.contact.copy(), tree.left[(tree.diameters == 0) & (tree.left >= 0)]
    contact[ends_of + 1] = contact[ends_of]
    lower, _ = searched(problem, replace(tree, contact=contact))
    assert lower > between_the_corners(name, fingers, span)
