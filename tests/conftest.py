"""Shared fixtures: the golden grasp, planned once."""

from pathlib import Path

import pytest

from planner.candidates.choice import make_candidates
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import write_grasp
from planner.limits.limits import Finger, Limits
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.task import make_task
from tests.tools.commands import ASSETS


@pytest.fixture(scope="session")
def prism() -> RigidObject:
    """The paper's Case III prism."""
    return read_object(ASSETS / "prism" / "prism.xml")


@pytest.fixture(scope="session")
def golden_grasp(prism: RigidObject) -> Grasp:
    """The paper's Case III: 217 candidates, three fingers, friction 0.3."""
    return plan(GraspProblem(prism, make_task("paper", prism), make_candidates(prism, "case3", 0.3, seed=0), fingers=3))


@pytest.fixture(scope="session")
def limited_grasp(prism: RigidObject) -> Grasp:
    """The same with a finger that is half as strong, and limits on distances that keep the best grasp."""
    fingers = (Finger(), Finger(), Finger(strength=0.5))
    limits = Limits(spacing=0.02, span=0.028, fingers=fingers)
    candidates = make_candidates(prism, "case3", 0.3, seed=0)
    return plan(GraspProblem(prism, make_task("paper", prism), candidates, fingers=3, limits=limits))


@pytest.fixture(scope="session")
def box_object() -> RigidObject:
    """The box of the assets."""
    return read_object(ASSETS / "box" / "box.xml")


@pytest.fixture(scope="session")
def soft_grasp(box_object: RigidObject) -> Grasp:
    """The box between two soft fingers, which press discs of 4 mm flat."""
    candidates = make_candidates(box_object, "40", 0.5, seed=0).twisting(patch=0.004)
    return plan(GraspProblem(box_object, make_task("gravity", box_object), candidates, fingers=2))


@pytest.fixture
def golden_file(golden_grasp: Grasp, tmp_path: Path) -> Path:
    """The golden grasp as a file of its own."""
    path = tmp_path / "golden.grasp.json"
    write_grasp(path, golden_grasp)
    return path
