"""The certified search, timed: several runs in one process, and its certificate checked by the independent verifier."""

import time
from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Floats
from planner.errors import RhograspError
from planner.grasps.grasp import Certificate
from planner.search.certified import CertifiedSearch
from planner.search.problem import SearchProblem
from planner.search.result import Status
from planner.verification.bound_check import Claim, check_bound
from scripts.search_benchmark.isolated import run_isolated

PATIENCE = 30.0
"""Seconds of runs after which no further one is begun."""

GRACE = 60.0
"""Seconds beyond the search's own limit after which its process is stopped."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CertifiedRun:
    """One run of the search."""

    seconds: float
    processor_seconds: float
    first_incumbent: float
    """Seconds to the first line of the log with a grasp."""
    nodes: int
    socp_solves: int
    status: Status
    rho: float
    lower_bound: float
    directions: Floats
    """The certificate, shape (cuts, D)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Certified:
    """The run of median time, the times of all, and what they took."""

    run: CertifiedRun

    seconds: tuple[float, ...]
    """Of every run, ascending."""

    peak_memory: int
    """Of the process of all runs [bytes]."""

    proven: bool | None = None
    """What the independent verifier says of the lower bound; None where it did not finish."""

    verifier_seconds: float = np.nan
    """Of the verifier, or its limit."""


def measure_certified(problem: SearchProblem, gap: float, runs: int, limit: float) -> Certified:
    """Run the search up to `runs` times, fewer where it is slow, in a process of its own.

    Args:
        problem: What to search.
        gap: Relative gap to prove.
        runs: How many runs at most.
        limit: Time limit of each [s].

    Raises:
        RhograspError: When the search ignores its time limit.
    """
    answer = run_isolated(_runs, problem, gap, runs, limit, limit=limit + max(limit, PATIENCE) + GRACE)
    if answer is None:
        raise RhograspError(f"the search did not end within {GRACE:g} s of its time limit of {limit:g} s")
    done = sorted(answer.value, key=lambda run: run.seconds)
    return Certified(
        run=done[len(done) // 2], seconds=tuple(run.seconds for run in done), peak_memory=answer.peak_memory
    )


def verify(problem: SearchProblem, certified: Certified, limit: float) -> Certified:
    """The same with the verdict of the independent verifier, which has `limit` seconds."""
    answer = run_isolated(_check, problem, certified.run, limit=limit)
    proven, seconds = (None, limit) if answer is None else answer.value
    return replace(certified, proven=proven, verifier_seconds=seconds)


def _runs(problem: SearchProblem, gap: float, runs: int, limit: float) -> list[CertifiedRun]:
    done: list[CertifiedRun] = []
    while len(done) < runs and sum(run.seconds for run in done) < PATIENCE:
        done.append(_run(problem, gap, limit))
    return done


def _run(problem: SearchProblem, gap: float, limit: float) -> CertifiedRun:
    problem = replace(problem)  # without what an earlier run has left in its caches
    wall, processor = time.perf_counter(), time.process_time()
    result = CertifiedSearch(gap=gap, time_limit=limit).run(problem)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    end = result.trace[-1]
    return CertifiedRun(
        seconds=wall,
        processor_seconds=processor,
        first_incumbent=next((line.seconds for line in result.trace if np.isfinite(line.incumbent)), np.inf),
        nodes=end.nodes,
        socp_solves=end.socp_solves,
        status=result.status,
        rho=result.rho,
        lower_bound=result.lower_bound,
        directions=result.cuts,
    )


def _check(problem: SearchProblem, run: CertifiedRun) -> tuple[bool, float]:
    certificate = Certificate(candidates=problem.contacts, cuts=run.directions)
    began = time.perf_counter()
    check = check_bound(certificate, Claim(problem.fingers, problem.reference_point, problem.wrenches, run.lower_bound))
    return check.proven, time.perf_counter() - began
