"""Planar grasps, as planned and as held in space."""

from functools import cache

from planner.candidates.choice import make_candidates
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.grasps.lift import in_space
from planner.objects.object_file import read_object_file
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.task import make_task
from tests.tools.commands import ASSETS

CASES = {"convex": "56", "concave": "86"}
"""Our planar objects and the candidates they are meant for."""


@cache
def planned(name: str, fingers: int) -> tuple[RigidObject, Grasp]:
    """The optimal grasp at friction 0.3, in space."""
    planar = read_object_file(ASSETS / "planar" / f"{name}.toml")
    assert isinstance(planar, PlanarObject)
    candidates = make_candidates(planar, CASES[name], 0.3, seed=0)
    return in_space(planar, plan(GraspProblem(planar, make_task("paper", planar), candidates, fingers)))
