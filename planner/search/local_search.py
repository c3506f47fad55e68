"""A strong first incumbent: single swaps on the cut table, corrected by exact evaluations.

The table overestimates 1 / rho of every subset. Climb it by swaps; evaluate the subset reached, most dangerous
vertex first; a vertex that the table had not foreseen gives a cut that lowers the table right there; climb again.
A start ends when the subset the table likes best nearby cannot beat the incumbent.
"""

from collections.abc import Callable

import numpy as np

from planner.arrays import Indices
from planner.contacts import wrench_scale
from planner.search.compiled.swaps import best_partner
from planner.search.cuts import CutTable
from planner.search.evaluation import Evaluation, Evaluator
from planner.search.incumbents import SOLVER_ACCURACY, Incumbents
from planner.search.problem import SearchProblem

STARTS = 2
"""Independent climbs; the search tree repairs what they miss."""

MOST_STEPS = 300
"""Corrections per climb."""

NEIGHBOURS = 300
"""Candidates that a climb looks at around its contacts."""

DRAWS = 20
"""Attempts at a random subset whose contacts keep spacing and span."""

PROBES = 3
"""Cases solved before a subset the table likes is evaluated in full."""

NOTICEABLE = 1e-3
"""Relative drop of a subset's bound that makes climbing again better than evaluating."""


def add_vertex_cuts(cuts: CutTable) -> None:
    """Add the direction that opposes each vertex of W_R: free cuts to start from."""
    problem = cuts.problem
    scale = wrench_scale(problem.contacts.dimension, problem.length) ** 2
    for wrench in problem.wrenches:
        cuts.add(-scale * wrench)


def climb(cuts: CutTable, subset: Indices, among: Indices) -> Indices:
    """Swap one candidate at a time while the bound of the table grows.

    Args:
        cuts: Cut table.
        subset: Where to start, shape (m,).
        among: Candidates that may be swapped in.

    Returns:
        A subset that no single swap improves, shape (m,), sorted.
    """
    subset = subset.copy()
    best = cuts.bound(subset)[0]
    slot, unimproved = 0, 0
    while unimproved < len(subset):
        unimproved += 1
        candidate, score = best_swap(cuts, subset, slot, among, best * (1 + 1e-9))
        if candidate >= 0:
            best, subset[slot], unimproved = score, candidate, 1
        slot = (slot + 1) % len(subset)
    return np.sort(subset)


def best_swap(cuts: CutTable, subset: Indices, slot: int, among: Indices, least: float) -> tuple[int, float]:
    """The candidate that, in place of one of the subset, has the largest bound, if that exceeds `least`; else -1."""
    problem = cuts.problem
    others = np.concatenate([subset[:slot], subset[slot + 1 :]])
    if problem.kinds or problem.pairs_are_limited:
        among = among[problem.partners(others)[among] & (problem.kind[among] == problem.kind[subset[slot]])]
    return best_partner(cuts.values, others, among, least)


def near(problem: SearchProblem, subset: Indices) -> Indices:
    """The NEIGHBOURS candidates closest to any of a subset's contacts; all if there are no more."""
    points = problem.contacts.points
    if len(points) <= NEIGHBOURS:
        return np.arange(len(points))
    squares = np.min([((points - point) ** 2).sum(axis=1) for point in points[subset]], axis=0)
    return np.argpartition(squares, NEIGHBOURS)[:NEIGHBOURS]


def random_subset(problem: SearchProblem, generator: np.random.Generator) -> Indices | None:
    """A random subset with the right kinds of fingers, spacing and span, shape (m,); None if none was met."""
    for _ in range(DRAWS):
        chosen = np.empty(0, dtype=np.int64)
        for kind in problem.kind_of_finger:
            allowed = np.flatnonzero(problem.partners(chosen) & (problem.kind == kind))
            if not len(allowed):
                break
            chosen = np.append(chosen, generator.choice(allowed))
        else:
            return np.sort(chosen)
    return None


def improve(
    evaluator: Evaluator,
    cuts: CutTable,
    subset: Indices,
    incumbents: Incumbents,
    stop: Callable[[], bool],
    among: Indices | None = None,
) -> Indices:
    """Climb from a subset until the table cannot beat the best grasp nearby; better ones are offered on the way.

    Args:
        evaluator: Solves inner problems.
        cuts: The table, sharpened on the way.
        subset: Where to start, shape (m,).
        incumbents: Where better grasps go.
        stop: Ends the climb once true.
        among: Candidates that may be swapped in; by default those near the subset's own.

    Returns:
        The subset at which the climb ended, shape (m,).
    """
    for _ in range(MOST_STEPS):
        if stop():
            break
        subset = climb(cuts, subset, near(cuts.problem, subset) if among is None else among)
        level = min(incumbents.rho, evaluator.problem.force_ceiling)
        if cuts.bound(subset)[0] <= (1 + SOLVER_ACCURACY) / level:
            break
        if sharpen(evaluator, cuts, subset):
            continue
        better = evaluate_below(evaluator, cuts, subset, level, stop)
        if better is not None:
            if not incumbents.offer(better):
                break
        elif cuts.bound(subset)[0] > (1 + SOLVER_ACCURACY) / level:
            break  # no better, and the solver cannot prove it: climbing again would come back here
    return subset


def sharpen(evaluator: Evaluator, cuts: CutTable, subset: Indices) -> bool:
    """Solve the few most dangerous cases; returns whether one lowered the subset's bound noticeably."""
    bound = cuts.bound(subset)[0]
    for case in cuts.dangerous_cases(subset)[:PROBES]:
        _, _, direction = evaluator.solve(subset, int(case))
        if cuts.add_if_below(direction, subset, bound * (1 - NOTICEABLE)):
            return True
    return False


def evaluate_below(
    evaluator: Evaluator, cuts: CutTable, subset: Indices, level: float, stop: Callable[[], bool] = lambda: False
) -> Evaluation | None:
    """Evaluate a subset only as far as needed to know whether its rho is below `level`.

    Every solved case that sharpens the subset's bound leaves its cut in the table. The evaluation stops as soon as
    the cuts, or a case, show rho_N >= level; then the answer is "not better", never the value of one case.

    Returns:
        The full evaluation if rho_N < level, else None; None too where it was stopped, with nothing shown.
    """
    bound = cuts.bound(subset)[0]
    solutions = {}
    for case in cuts.dangerous_cases(subset).tolist():
        solutions[case] = evaluator.solve(subset, case)
        _, phi, direction = solutions[case]
        if cuts.add_if_below(direction, subset, bound * (1 - 1e-9)):
            bound = cuts.bound(subset)[0]
        if bound <= 1 / level or phi >= level * (1 + SOLVER_ACCURACY):
            return None
        if len(solutions) < evaluator.problem.cases and stop():
            return None
    return evaluator.collect(subset, [solutions[case] for case in sorted(solutions)])
