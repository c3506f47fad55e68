"""The few cuts that a finished proof needs, chosen greedily: a shorter certificate, sooner checked.

Walk the tree once more with the final bound. Rows that a chosen cut prunes need nothing; of the cuts that prune the
others, the one that prunes most rows is chosen, again and again; rows that no cut prunes are split. What is pruned in
float32 is so in truth, see `planner.search.node_bounds`; single subsets, whose bounds may be the proven one itself, are
told in float64. So what is chosen proves the very bound that all the cuts prove.
"""

import time
from collections.abc import Callable

import numpy as np

from planner.arrays import Floats, Mask
from planner.contact_models.models import free_to_turn
from planner.search.branch_and_bound import BATCH
from planner.search.constraints.constraint import Constraints
from planner.search.constraints.every_grasp import on_every_grasp
from planner.search.cuts import CutTable
from planner.search.node_bounds import NodeBounds
from planner.search.problem import SearchProblem
from planner.search.regions.candidate_tree import build_tree
from planner.search.regions.rows import BoundedRows, Frontier, split
from planner.search.result import SearchResult, Status

ROUNDING = 1e-10
"""Relative slack for the rounding of a sum of a few numbers; `planner.verification` allows ten times as much."""


def minimal_cuts(result: SearchResult, stop: Callable[[], bool] = lambda: False) -> Floats:
    """The directions of a result that already prove its lower bound; all of them where choosing takes too long.

    Args:
        result: Of a certified search.
        stop: Once true, all are kept.

    Returns:
        Shape (cuts, D). All are kept where the search is not finished, where choosing is stopped, or needs more time
        again than the search took.
    """
    problem = result.problem
    if free_to_turn(problem.contacts, problem.fingers) or result.status not in (Status.OPTIMAL, Status.INFEASIBLE):
        return result.cuts
    enough = time.perf_counter() + result.trace[-1].seconds
    everything = CutTable(problem)
    for direction in result.cuts:
        if stop():
            return result.cuts
        everything.add(direction)
    walk = _Walk(problem, everything, 1 / result.lower_bound)
    while len(walk.frontier):
        if time.perf_counter() > enough or stop() or not walk.advance():
            return result.cuts
    return walk.chosen.directions


class _Walk:
    """State of one walk over the tree."""

    def __init__(self, problem: SearchProblem, everything: CutTable, threshold: float) -> None:
        self.threshold, self.everything, self.chosen = threshold, everything, CutTable(problem)
        self.tree = build_tree(problem)
        self.constraints = Constraints(on_every_grasp(problem, self.tree))
        self.all_bounds, self.bounds = NodeBounds(self.tree, everything), NodeBounds(self.tree, self.chosen)
        self.all_bounds.extend()
        self.frontier = Frontier(problem.fingers)
        self.frontier.push(BoundedRows.unbounded(self.tree.first_row[None]))

    def advance(self) -> bool:
        """Prune the most recent rows, by new cuts where needed, and split the others; False: a subset is not proven."""
        rows = self.frontier.pop(BATCH)
        rows = rows[self.constraints.possible(rows.nodes)]
        self.bounds.extend()
        rows = self.bounds.bound(rows, self.threshold)
        rows = rows[rows.bounds > self.threshold]
        single = (self.tree.sizes[rows.nodes] == 1).all(axis=1)
        known = np.zeros(len(rows), dtype=bool)
        known[single] = self.pruned(self.chosen, rows[single]).any(axis=1)
        rows, single = rows[~known], single[~known]
        prunes = self.all_bounds.prunes(rows.nodes, self.threshold)
        prunes[single] = self.pruned(self.everything, rows[single])
        for cut in greedy_cover(prunes):
            self.chosen.add(self.everything.directions[cut])
        left = np.flatnonzero(~prunes.any(axis=1))
        if single[left].any():
            return False
        if len(left):
            self.frontier.push(split(rows[left], self.tree))
        return True

    def pruned(self, cuts: CutTable, subsets: BoundedRows) -> Mask:
        """Which cuts prune which rows of single candidates, in float64, shape (rows, cuts)."""
        sums = cuts.values[self.tree.contact[subsets.nodes]].sum(axis=1)
        return np.asarray(sums <= self.threshold * (1 + ROUNDING))


def greedy_cover(prunes: Mask) -> list[int]:
    """Few columns that together hold a True in every row that has one.

    Args:
        prunes: Shape (rows, columns).
    """
    chosen = []
    left = prunes[prunes.any(axis=1)]
    while len(left):
        chosen.append(int(left.sum(axis=0).argmax()))
        left = left[~left[:, chosen[-1]]]
    return chosen
