"""The one verb that plans: a problem in, the best grasp and its proof out."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np

from planner.files.json_document import finite_or_none
from planner.files.package_versions import package_versions
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp, ProofCheck, SearchRecord, TraceLine
from planner.search.certified import CertifiedSearch
from planner.search.evaluation import Evaluation
from planner.search.result import Progress, SearchResult, Status, relative_gap
from planner.verification.proof_check import certificate_of, with_checked_proof

MOST_TRACE_LINES = 200
"""Lines of the search log that a grasp keeps."""


def plan(
    problem: GraspProblem,
    search: CertifiedSearch | None = None,
    observe: Callable[[Progress], None] = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
) -> Grasp:
    """The best grasp, see `plan_several`."""
    return plan_several(problem, search, observe, stop)[0]


def plan_several(
    problem: GraspProblem,
    search: CertifiedSearch | None = None,
    observe: Callable[[Progress], None] = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
) -> tuple[Grasp, ...]:
    """Choose the contacts that resist the task with the smallest fingertip force, prove it, and check the proof.

    With limits, contact k is that of finger k of the limits, and rho is the force level: finger k must be able to push
    with its strength times rho.

    Args:
        problem: What is planned.
        search: The search and its gap, time limit and seed; by default a proof to 0.1 %.
        observe: Called with every line of the search log as it happens.
        stop: Once it returns true, the search ends with the best grasp and the gap it has.

    Returns:
        The grasps that the search was asked for, best first; at least one, without contacts if none was found.

    Raises:
        CandidateError: When there are fewer candidates than fingers.
        LimitsError: When the limits do not fit the object, the number of fingers or the candidates.
        TaskError: When the task asks for nothing.
    """
    search = search or CertifiedSearch()
    enough = perf_counter() + search.time_limit
    result = search.run(problem.search_problem, observe, stop)
    result, check = with_checked_proof(result, lambda: stop() or perf_counter() >= enough)
    found = result.grasps or (None,)
    return tuple(_grasp(problem, search, result, check, evaluation) for evaluation in found)


def _grasp(
    planned: GraspProblem,
    search: CertifiedSearch,
    result: SearchResult,
    check: ProofCheck | None,
    found: Evaluation | None,
) -> Grasp:
    problem, end, kinds = result.problem, result.trace[-1], planned.kinds
    rigid_object, candidates = planned.rigid_object, kinds.candidates
    order = kinds.in_finger_order(found.subset) if found else np.empty(0, dtype=np.int64)
    chosen = found.subset[order] if found else order
    contacts = problem.contacts.subset(chosen)
    return Grasp(
        source=rigid_object.source,
        sha256=rigid_object.sha256,
        body=rigid_object.body,
        mass=rigid_object.mass,
        task=planned.task,
        contacts=replace(contacts, strength=problem.strengths[chosen]) if problem.kinds else contacts,
        geoms=tuple(rigid_object.parts[part].geom for part in candidates.part[chosen]),
        chosen=chosen,
        lower_bound=result.lower_bound,
        status=_status(result, search.gap, found),
        phi=found.phi if found else np.empty(0),
        forces=found.forces[:, order] if found else np.empty((0, 0, contacts.dimension)),
        torques=found.torques[:, order] if found else np.empty((0, 0)),
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
        packages=package_versions(),
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
            incumbent=finite_or_none(line.incumbent),
            socp_solves=line.socp_solves,
            cuts=line.cuts,
        )
        for line in (trace[i] for i in kept)
    )
