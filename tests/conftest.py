"""Shared fixtures: the golden grasp, planned once."""

from pathlib import Path

import pytest

from planner.candidates.choice import make_candidates
from planner.grasp import Grasp
from planner.grasp_file import write_grasp
from planner.objects.mjcf import read_object
from planner.objects.rigid_object import RigidObject
from planner.plan import plan
from planner.task import make_task
from tests.commands import ASSETS


@pytest.fixture(scope="session")
def prism() -> RigidObject:
    """The paper's Case III prism."""
    return read_object(ASSETS / "prism" / "prism.xml")


@pytest.fixture(scope="session")
def golden_grasp(prism: RigidObject) -> Grasp:
    """The paper's Case III: 217 candidates, three fingers, friction 0.3."""
    return plan(prism, make_task("paper", prism), make_candidates(prism, "case3", 0.3, seed=0), fingers=3)


@pytest.fixture
def golden_file(golden_grasp: Grasp, tmp_path: Path) -> Path:
    """The golden grasp as a file of its own."""
    path = tmp_path / "golden.grasp.json"
    write_grasp(path, golden_grasp)
    return path
