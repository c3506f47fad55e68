"""The one verb that plans: object, task and candidates in, the best grasp and its proof out."""

from collections.abc import Callable
from importlib.metadata import version

import numpy as np

from planner.candidates.candidates import Candidates
from planner.grasp import Certificate, Grasp, SearchRecord
from planner.objects.given_mass import NOTHING_GIVEN
from planner.objects.graspable import Graspable
from planner.objects.rigid_object import RigidObject
from planner.search.certified import CertifiedSearch
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult
from planner.task import Task

PACKAGES = ("rhograsp", "mujoco", "numpy", "scipy", "clarabel", "trimesh")
"""Packages whose versions a grasp records."""


def plan(
    rigid_object: Graspable,
    task: Task,
    candidates: Candidates,
    fingers: int,
    search: CertifiedSearch | None = None,
    observe: Callable[[Progress], None] = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
) -> Grasp:
    """Choose the contacts that resist the task with the smallest fingertip force, and prove it.

    Args:
        rigid_object: What is grasped.
        task: The wrenches it must be held against.
        candidates: Where fingers may go.
        fingers: How many fingers.
        search: The search and its gap, time limit and seed; by default a proof to 0.1 %.
        observe: Called with every line of the search log as it happens.
        stop: Once it returns true, the search ends with the best grasp and the gap it has.

    Raises:
        CandidateError: When there are fewer candidates than fingers.
        TaskError: When the task asks for nothing.
    """
    search = search or CertifiedSearch()
    problem = SearchProblem(
        contacts=candidates.contacts,
        fingers=fingers,
        reference_point=task.reference_point,
        wrenches=task.wrenches,
    )
    result = search.run(problem, observe, stop)
    return _grasp(rigid_object, task, candidates, search, result)


def _grasp(
    rigid_object: Graspable, task: Task, candidates: Candidates, search: CertifiedSearch, result: SearchResult
) -> Grasp:
    problem, best, end = result.problem, result.incumbent, result.trace[-1]
    dimension = problem.contacts.dimension
    chosen = best.subset if best else np.empty(0, dtype=np.int64)
    return Grasp(
        file=rigid_object.file,
        sha256=rigid_object.sha256,
        body=rigid_object.body,
        mass=rigid_object.mass,
        task=task,
        contacts=problem.contacts.subset(chosen),
        geoms=tuple(rigid_object.parts[part].geom for part in candidates.part[chosen]),
        candidates=chosen,
        lower_bound=result.lower_bound,
        status=result.status,
        phi=best.phi if best else np.empty(0),
        forces=best.forces if best else np.empty((0, 0, dimension)),
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
        ),
        certificate=Certificate(candidates=problem.contacts, cuts=result.directions),
        packages={name: version(name) for name in PACKAGES},
        given=rigid_object.given if isinstance(rigid_object, RigidObject) else NOTHING_GIVEN,
    )
