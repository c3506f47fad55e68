"""The few cuts that a finished proof needs, chosen greedily: a shorter certificate, sooner checked.

Walk the tree once more with the final bound. Rows that a chosen cut prunes need nothing; of the cuts that prune the
others, the one that prunes most rows is chosen, again and again; rows that no cut prunes are split.
"""

import time
from collections.abc import Callable

import numpy as np

from planner.search.branch_and_bound import BATCH
from planner.search.cuts import CutTable
from planner.search.frontier import Frontier, split
from planner.search.node_bounds import NodeBounds
from planner.search.result import SearchResult, Status
from planner.search.spacing import Spacing
from planner.search.tree import build_tree

SLACK = 2e-6
"""By how much, relatively, the float32 bounds of the walk may exceed those of the proof."""


def needed_directions(result: SearchResult, stop: Callable[[], bool] = lambda: False) -> np.ndarray:
    """The directions of a result that already prove its lower bound; all of them where choosing takes too long.

    Args:
        result: Of a certified search.
        stop: Ends the choice once true.

    Returns:
        Shape (cuts, D). All are kept where the search is not finished, where choosing is stopped, or needs more time
        again than the search took.
    """
    problem = result.problem
    pairs_in_space = problem.fingers == 2 and problem.contacts.dimension == 3
    if pairs_in_space or result.status not in (Status.OPTIMAL, Status.INFEASIBLE):
        return result.directions
    enough = time.perf_counter() + result.trace[-1].seconds
    tree, threshold = build_tree(problem), (1 + SLACK) / result.lower_bound
    spacing, everything, chosen = Spacing(problem, tree), CutTable(problem), CutTable(problem)
    for direction in result.directions:
        if stop():
            return result.directions
        everything.add(direction)
    all_bounds, bounds = NodeBounds(tree, everything), NodeBounds(tree, chosen)
    all_bounds.extend()
    frontier = Frontier(problem.fingers)
    frontier.push(tree.first_row[None], np.array([np.inf]))
    while len(frontier):
        if time.perf_counter() > enough or stop():
            return result.directions
        rows, known = frontier.pop(BATCH)
        possible = spacing.possible(rows)
        rows, known = rows[possible], known[possible]
        bounds.extend()
        rows = rows[bounds.bound(rows, known, threshold) > threshold]
        kills = all_bounds.kills(rows, threshold)
        for cut in greedy_cover(kills):
            chosen.add(everything.directions[cut])
        rows = rows[~kills.any(axis=1)]
        if (tree.sizes[rows] == 1).all(axis=1).any():
            return result.directions  # too close to tell in float32
        if len(rows):
            children, _ = split(rows, tree)
            frontier.push(children, np.full(len(children), np.inf))
    return chosen.directions


def greedy_cover(kills: np.ndarray) -> list[int]:
    """Few columns that together hold a True in every row that has one.

    Args:
        kills: Shape (rows, columns).
    """
    chosen = []
    left = kills[kills.any(axis=1)]
    while len(left):
        chosen.append(int(left.sum(axis=0).argmax()))
        left = left[~left[:, chosen[-1]]]
    return chosen
