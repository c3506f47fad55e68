"""A search's proof, shortened, and checked by code that shares nothing with the search, before it is called a proof.

The check may take a second, or a tenth of what the search took where that is longer. What it does not reach by then is
left to `grasp-verify`, and said.
"""

import logging
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from planner.grasps.grasp import Certificate, ProofCheck
from planner.search.minimal_cuts import minimal_cuts
from planner.search.result import SearchResult, Status
from planner.verification.bound_check import BoundCheck, Claim, check_bound

logger = logging.getLogger(__name__)

LEAST_TIME = 1.0
"""Always allowed for the check [s]."""

SHARE_OF_SEARCH = 0.1
"""Of the time of the search, what the check may take where that is more."""


def with_checked_proof(result: SearchResult, stop: Callable[[], bool]) -> tuple[SearchResult, ProofCheck | None]:
    """The result with few cuts that prove its bound, and how much of that was checked.

    What does not check is not handed on. If the few cuts do not prove the bound, all are taken; if these do not either,
    that is an error of the search: the bound is lowered to what they do prove, to 0 where the check is stopped before
    that is known, and the status is UNRESOLVED.

    Args:
        result: Of a certified search.
        stop: Once true, the check ends with the share that it has reached.

    Returns:
        The result, and None in place of the check where no bound is claimed.
    """
    if result.lower_bound <= 0:
        return result, None
    short = replace(result, cuts=minimal_cuts(result, stop))
    began = perf_counter()
    until = began + max(LEAST_TIME, SHARE_OF_SEARCH * result.trace[-1].seconds)

    def enough() -> bool:
        return stop() or perf_counter() > until

    proven = short
    check = _check(short, enough)
    if check.counterexample:
        proven, check = result, _check(result, enough)
    while check.counterexample:
        proven = replace(result, status=Status.UNRESOLVED, lower_bound=0.0 if enough() else check.weaker)
        check = _check(proven, enough) if proven.lower_bound else BoundCheck(method=check.method, share=0.0)
    if proven.lower_bound < result.lower_bound:
        if not check.proven:  # the time is over, and another counterexample may be left
            proven = replace(proven, lower_bound=0.0)
        logger.warning(
            "the search's proof does not check: its cuts prove %.9g N, not %.9g N; this is an error of this program, "
            "please report the command and the object",
            proven.lower_bound,
            result.lower_bound,
        )
    if proven.lower_bound <= 0:
        return proven, None
    return proven, ProofCheck(share=check.share, seconds=perf_counter() - began)


def certificate_of(result: SearchResult) -> Certificate:
    """What anyone needs to check the bound of a search."""
    problem = result.problem
    return Certificate(
        candidates=problem.contacts,
        cuts=result.cuts,
        kinds=problem.kinds,
        **result.stated,
    )


def _check(result: SearchResult, stop: Callable[[], bool]) -> BoundCheck:
    problem = result.problem
    return check_bound(
        certificate_of(result),
        Claim(problem.fingers, problem.reference_point, problem.wrenches, result.lower_bound),
        stop=stop,
    )
