"""The one verb that plans: object, task and candidates in, the best grasp and its proof out."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from importlib.metadata import version
from math import isfinite
from time import perf_counter

import numpy as np

from planner.candidates.candidates import Candidates
from planner.grasp import Grasp, ProofCheck, SearchRecord, TraceLine
from planner.limits.kinds import Kinds, finger_kinds
from planner.limits.limits import Limits
from planner.limits.restricted import restricted
from planner.objects.graspable import Graspable
from planner.proof_check import certificate_of, with_checked_proof
from planner.search.certified import CertifiedSearch
from planner.search.evaluation import Evaluation
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult, Status, relative_gap
from planner.task import Task

PACKAGES = ("rhograsp", "mujoco", "numpy", "scipy", "clarabel", "trimesh")
"""Packages whose versions a grasp records."""

MOST_TRACE_LINES = 200
"""Lines of the search log that a grasp keeps."""


def plan(
    rigid_object: Graspable,
    task: Task,
    candidates: Candidates,
    fingers: int,
    search: CertifiedSearch | None = None,
    observe: Callable[[Progress], None] = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
    limits: Limits | None = None,
) -> Grasp:
    """The best grasp, see `plan_several`."""
    return plan_several(rigid_object, task, candidates, fingers, search, observe, stop, limits)[0]


def plan_several(
    rigid_object: Graspable,
    task: Task,
    candidates: Candidates,
    fingers: int,
    search: CertifiedSearch | None = None,
    observe: Callable[[Progress], None] = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
    limits: Limits | None = None,
) -> tuple[Grasp, ...]:
    """Choose the contacts that resist the task with the smallest fingertip force, prove it, and check the proof.

    With limits, contact k is that of finger k of the limits, and rho is the force level: finger k must be able to push
    with its strength times rho.

    Args:
        rigid_object: What is grasped.
        task: The wrenches it must be held against.
        candidates: Where fingers may go.
        fingers: How many fingers.
        search: The search and its gap, time limit and seed; by default a proof to 0.1 %.
        observe: Called with every line of the search log as it happens.
        stop: Once it returns true, the search ends with the best grasp and the gap it has.
        limits: What the fingers can do; candidates that no finger may use are left out.

    Returns:
        The grasps that the search was asked for, best first; at least one, without contacts if none was found.

    Raises:
        CandidateError: When there are fewer candidates than fingers.
        LimitsError: When the limits do not fit the object, the number of fingers or the candidates.
        TaskError: When the task asks for nothing.
    """
    limits = limits or Limits()
    allowed = restricted(rigid_object, candidates, limits).candidates
    kinds = finger_kinds(rigid_object, allowed, fingers, limits)
    return plan_within(rigid_object, task, kinds, limits, search, observe, stop)


def plan_within(
    rigid_object: Graspable,
    task: Task,
    kinds: Kinds,
    limits: Limits,
    search: CertifiedSearch | None = None,
    observe: Callable[[Progress], None] = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
) -> tuple[Grasp, ...]:
    """`plan_several` for callers that have asked the limits already which candidates are for which fingers.

    Args:
        rigid_object: What is grasped.
        task: The wrenches it must be held against.
        kinds: The fingers and their candidates.
        limits: Of these, spacing and span are still to be kept.
        search: See `plan_several`.
        observe: See `plan_several`.
        stop: See `plan_several`.
    """
    search = search or CertifiedSearch()
    problem = SearchProblem(
        contacts=kinds.candidates.contacts,
        fingers=len(kinds.of_finger),
        reference_point=task.reference_point,
        wrenches=task.wrenches,
        kinds=kinds.kinds,
        spacing=limits.spacing,
        span=limits.span,
    )
    enough = perf_counter() + search.time_limit
    result = search.run(problem, observe, stop)
    result, check = with_checked_proof(result, lambda: stop() or perf_counter() >= enough)
    found = result.grasps or (None,)
    return tuple(_grasp(rigid_object, task, kinds, search, result, check, evaluation) for evaluation in found)


def _grasp(
    rigid_object: Graspable,
    task: Task,
    kinds: Kinds,
    search: CertifiedSearch,
    result: SearchResult,
    check: ProofCheck | None,
    found: Evaluation | None,
) -> Grasp:
    problem, end, candidates = result.problem, result.trace[-1], kinds.candidates
    order = kinds.in_finger_order(found.subset) if found else np.empty(0, dtype=np.int64)
    chosen = found.subset[order] if found else order
    contacts = problem.contacts.subset(chosen)
    return Grasp(
        source=rigid_object.source,
        sha256=rigid_object.sha256,
        body=rigid_object.body,
        mass=rigid_object.mass,
        task=task,
        contacts=replace(contacts, strength=problem.strengths[chosen]) if problem.kinds else contacts,
        geoms=tuple(rigid_object.parts[part].geom for part in candidates.part[chosen]),
        candidates=chosen,
        lower_bound=result.lower_bound,
        status=_status(result, search.gap, found),
        phi=found.phi if found else np.empty(0),
        forces=found.forces[:, order] if found else np.empty((0, 0, contacts.dimension)),
        search=SearchRecord(
            method=result.method,
            fingers=problem.fingers,
            candidates=len(problem.contacts),
            subsets=problem.subsets,
            nodes=end.nodes,
            socp_solves=end.socp_solves,
            cuts=end.cuts,
            seconds=end.seconds,
            seed=search.seed,
            gap=search.gap,
            trace=recorded(result.trace),
        ),
        certificate=certificate_of(result),
        proof_check=check,
        packages={name: version(name) for name in PACKAGES},
        center_of_mass=rigid_object.center_of_mass,
        candidate_choice=candidates.choice,
    )


def _status(result: SearchResult, gap: float, found: Evaluation | None) -> Status:
    """That of the search for its best grasp, and for those that are as good within the gap."""
    as_good = found is None or relative_gap(found.rho, result.lower_bound) <= max(gap, result.gap)
    return result.status if as_good else Status.ALTERNATIVE


def recorded(trace: Sequence[Progress]) -> tuple[TraceLine, ...]:
    """A search log as a grasp keeps it: if it is long, lines at even steps, the first and the last among them."""
    kept = np.linspace(0, len(trace) - 1, min(len(trace), MOST_TRACE_LINES)).round().astype(int)
    return tuple(
        TraceLine(
            seconds=line.seconds,
            nodes=line.nodes,
            open=line.open,
            lower_bound=line.lower_bound,
            incumbent=line.incumbent if isfinite(line.incumbent) else None,
            socp_solves=line.socp_solves,
            cuts=line.cuts,
        )
        for line in (trace[i] for i in kept)
    )
