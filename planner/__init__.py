"""Certified optimal grasps on MJCF objects: one call per job.

    mug = planner.read_object("mug.xml")
    task = planner.make_task("gravity", mug)
    problem = planner.GraspProblem(mug, task, planner.make_candidates(mug, "300", friction=0.5), fingers=3)
    grasp = planner.plan(problem)
    checks = planner.verify(grasp)
    planner.write_grasp("mug.grasp.json", grasp)

Fingers with pads are soft: `make_candidates(...).twisting(patch=0.004)` gives them torsional friction, and the torques
about the normals are `grasp.torques`.

What is not asked for is not imported: `import planner` costs nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planner.candidates.choice import make_candidates
    from planner.grasp_problem import GraspProblem, GraspRequest, pose_problem
    from planner.grasps.grasp import Grasp
    from planner.grasps.grasp_file import read_grasp, write_grasp
    from planner.limits.limits_file import read_limits
    from planner.objects.object_file import read_object_file as read_object
    from planner.objects.object_source import ObjectSource
    from planner.planning import plan, plan_several
    from planner.search.certified import CertifiedSearch
    from planner.task import Task, make_task
    from planner.verification.verify import verify

__all__ = [
    "CertifiedSearch",
    "Grasp",
    "GraspProblem",
    "GraspRequest",
    "ObjectSource",
    "Task",
    "make_candidates",
    "make_task",
    "plan",
    "plan_several",
    "pose_problem",
    "read_grasp",
    "read_limits",
    "read_object",
    "verify",
    "write_grasp",
]

_HOMES = {
    "CertifiedSearch": "planner.search.certified:CertifiedSearch",
    "GraspProblem": "planner.grasp_problem:GraspProblem",
    "GraspRequest": "planner.grasp_problem:GraspRequest",
    "Grasp": "planner.grasps.grasp:Grasp",
    "ObjectSource": "planner.objects.object_source:ObjectSource",
    "Task": "planner.task:Task",
    "make_candidates": "planner.candidates.choice:make_candidates",
    "make_task": "planner.task:make_task",
    "plan": "planner.planning:plan",
    "plan_several": "planner.planning:plan_several",
    "pose_problem": "planner.grasp_problem:pose_problem",
    "read_grasp": "planner.grasps.grasp_file:read_grasp",
    "read_limits": "planner.limits.limits_file:read_limits",
    "read_object": "planner.objects.object_file:read_object_file",
    "verify": "planner.verification.verify:verify",
    "write_grasp": "planner.grasps.grasp_file:write_grasp",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'planner' has no attribute {name!r}; it has {', '.join(__all__)}")
    module, attribute = _HOMES[name].split(":")
    return getattr(import_module(module), attribute)
