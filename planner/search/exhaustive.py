"""Every subset, one after another: the slow clear twin of the certified search and its oracle."""

from itertools import combinations

import numpy as np

from planner.search.evaluation import Evaluation, Evaluator
from planner.search.problem import SearchProblem


def exhaustive_search(problem: SearchProblem) -> Evaluation | None:
    """The best subset by enumeration, or None when no subset resists W_R with forces below the ceiling.

    A subset is left as soon as one case needs as much as the best subset so far.
    """
    evaluator = Evaluator(problem)
    best: Evaluation | None = None
    least = problem.force_ceiling
    for combination in combinations(range(len(problem.contacts)), problem.fingers):
        subset = np.array(combination)
        if problem.admits(subset) and all(evaluator.solve(subset, case)[1] < least for case in range(problem.cases)):
            best = evaluator.evaluate(subset)
            least = best.rho
    return best
