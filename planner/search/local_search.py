"""A strong first incumbent: single swaps on the cut table, corrected by exact evaluations.

The table overestimates 1 / rho of every subset. Climb it by swaps; evaluate the subset reached, most dangerous
vertex first; a vertex that the table had not foreseen gives a cut that lowers the table right there; climb again.
A start ends when the subset the table likes best nearby cannot beat the incumbent.
"""

from collections.abc import Callable

import numpy as np

from planner.search.cuts import CutTable
from planner.search.evaluation import Evaluation, Evaluator
from planner.search.incumbents import SOLVER_ACCURACY, Incumbents

STARTS = 2
"""Independent climbs; the search tree repairs what they miss."""

MOST_STEPS = 300
"""Corrections per climb."""

DECISIVE = 16
"""Rows of the table that every swap is checked against."""

PROBES = 1
"""Vertices solved before a subset the table likes is evaluated in full."""

NOTICEABLE = 1e-3
"""Relative drop of a subset's bound that makes climbing again better than evaluating."""


def add_vertex_cuts(cuts: CutTable) -> None:
    """Add the direction that opposes each vertex of W_R: free cuts to start from."""
    problem = cuts.problem
    scale = np.ones(problem.wrenches.shape[1])
    scale[problem.contacts.dimension :] /= problem.length**2
    for wrench in problem.wrenches:
        cut = cuts.evaluate(-scale * wrench)
        if cut is not None:
            cuts.add(cut)


def climb(values: np.ndarray, subset: np.ndarray) -> np.ndarray:
    """Swap one candidate at a time while the smallest row sum of the table grows.

    Args:
        values: Cut table, shape (cuts, n).
        subset: Where to start, shape (m,).

    Returns:
        A subset that no single swap improves, shape (m,), sorted.
    """
    subset = subset.copy()
    best = values[:, subset].sum(axis=1).min()
    slot, unimproved = 0, 0
    while unimproved < len(subset):
        unimproved += 1
        candidate, score = best_swap(values, np.delete(subset, slot), best * (1 + 1e-9))
        if candidate >= 0:
            best, subset[slot], unimproved = score, candidate, 1
        slot = (slot + 1) % len(subset)
    return np.sort(subset)


def best_swap(values: np.ndarray, others: np.ndarray, least: float) -> tuple[int, float]:
    """The candidate that, with the others, has the largest smallest row sum, if that exceeds `least`; else -1.

    The rows in which the others sum to least decide nearly always: the rest of the table is only read for the
    candidates that pass those.
    """
    base = values[:, others].sum(axis=1)
    decisive = np.argpartition(base, DECISIVE - 1)[:DECISIVE] if len(base) > DECISIVE else np.arange(len(base))
    scores = (values[decisive] + base[decisive, None]).min(axis=0)
    scores[others] = -np.inf
    passing = np.flatnonzero(scores > least)
    scores = (values[:, passing] + base[:, None]).min(axis=0)
    if scores.max(initial=least) <= least:
        return -1, least
    chosen = int(scores.argmax())
    return int(passing[chosen]), float(scores[chosen])


def improve(
    evaluator: Evaluator, cuts: CutTable, subset: np.ndarray, incumbents: Incumbents, stop: Callable[[], bool]
) -> None:
    """Climb from a subset until the table cannot beat the best grasp nearby; better ones are offered on the way."""
    for _ in range(MOST_STEPS):
        if stop():
            break
        subset = climb(cuts.values, subset)
        level = min(incumbents.rho, evaluator.problem.force_ceiling)
        if cuts.bound(subset)[0] <= (1 + SOLVER_ACCURACY) / level:
            break
        if sharpen(evaluator, cuts, subset):
            continue
        better = evaluate_below(evaluator, cuts, subset, level)
        if better is not None:
            incumbents.offer(better)
        elif cuts.bound(subset)[0] > (1 + SOLVER_ACCURACY) / level:
            break  # no better, and the solver cannot prove it: climbing again would come back here


def sharpen(evaluator: Evaluator, cuts: CutTable, subset: np.ndarray) -> bool:
    """Solve the few most dangerous vertices; returns whether one lowered the subset's bound noticeably."""
    bound = cuts.bound(subset)[0]
    for vertex in cuts.dangerous_vertices(subset)[:PROBES]:
        _, _, direction = evaluator.solve(subset, int(vertex))
        if add_if_sharper(cuts, subset, direction, bound * (1 - NOTICEABLE)):
            return True
    return False


def evaluate_below(evaluator: Evaluator, cuts: CutTable, subset: np.ndarray, level: float) -> Evaluation | None:
    """Evaluate a subset only as far as needed to know whether its rho is below `level`.

    Every solved vertex that sharpens the subset's bound leaves its cut in the table. The evaluation stops as soon as
    the cuts, or a vertex, show rho_N >= level; then the answer is "not better", never the value of one vertex.

    Returns:
        The full evaluation if rho_N < level, else None.
    """
    bound = cuts.bound(subset)[0]
    solutions = {}
    for vertex in cuts.dangerous_vertices(subset).tolist():
        solutions[vertex] = evaluator.solve(subset, vertex)
        _, phi, direction = solutions[vertex]
        if add_if_sharper(cuts, subset, direction, bound * (1 - 1e-9)):
            bound = cuts.bound(subset)[0]
        if bound <= 1 / level or phi >= level * (1 + SOLVER_ACCURACY):
            return None
    return evaluator.collect(subset, [solutions[vertex] for vertex in sorted(solutions)])


def add_if_sharper(cuts: CutTable, subset: np.ndarray, direction: np.ndarray, bound: float) -> bool:
    """Add the cut of a direction if it bounds 1 / rho of the subset below `bound`; returns whether it did."""
    cut = cuts.evaluate(direction)
    if cut is None or cut.values[subset].sum() >= bound:
        return False
    cuts.add(cut)
    return True
