"""Where two hard fingers hold nothing: would pads? The same plan once more, for a moment."""

from collections.abc import Callable
from dataclasses import replace

from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.objects.plausibility import torsion_doubts
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.verification.why_infeasible import PAD, is_hard_pair

SHARE = 0.1
"""Of the time that the plan took, for the plan with pads."""

LEAST_SECONDS = 1.0
"""Or so much, where that is more [s]."""


def planned_with_pads(
    problem: GraspProblem, grasp: Grasp, left: float, stop: Callable[[], bool] = lambda: False
) -> Grasp | None:
    """The plan with pads of radius PAD, its gap open where time was short.

    Args:
        problem: What was planned.
        grasp: What came of it.
        left: Time that there is [s].
        stop: Once it returns true, the search ends.

    Returns:
        None where it is not about two hard fingers, where limits say how the fingers twist, or the object is too small
        for such pads.
    """
    if any(finger.twist_is_said for finger in problem.limits.fingers) or not is_hard_pair(grasp):
        return None
    padded = replace(problem, candidates=problem.candidates.twisting(None, PAD))
    if torsion_doubts(problem.rigid_object, padded.candidates.contacts):
        return None
    seconds = min(left, max(LEAST_SECONDS, SHARE * grasp.search.seconds))
    return plan(padded, CertifiedSearch(time_limit=seconds, seed=grasp.search.seed), stop=stop)
