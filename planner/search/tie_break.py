"""The paper's tie-break: of equally good grasps, the one whose forces are smallest all together.

    min over the tied N of  max over w in W_R of  min { sqrt(sum_i f_i . f_i) : f satisfies (2), (3) }

Source: Watanabe and Yoshikawa, section 4.
"""

from planner.forces.least_total import largest_least_total
from planner.search.evaluation import Evaluation
from planner.search.problem import SearchProblem


def tie_break(problem: SearchProblem, tied: tuple[Evaluation, ...]) -> tuple[Evaluation, float]:
    """The tied grasp with the smallest criterion; of symmetric ones, which share it, the first.

    Args:
        problem: Whose candidates the grasps choose from.
        tied: At least one grasp, for example all within a tolerance of the optimum.

    Returns:
        The grasp and its criterion [N].

    Raises:
        ContactError: When a finger has torsional friction, of which the paper knows nothing.
    """
    criteria = [
        largest_least_total(problem.contacts.subset(grasp.subset), problem.reference_point, problem.wrenches)
        for grasp in tied
    ]
    least = min(criteria)
    chosen = next(i for i, criterion in enumerate(criteria) if criterion <= least * (1 + SYMMETRIC))
    return tied[chosen], criteria[chosen]


SYMMETRIC = 1e-6
"""Criteria closer than this, relatively, are those of symmetric arrangements."""
