"""Every object this project makes is planned with a proof and confirmed by MuJoCo."""

import pytest

from planner.candidates.choice import make_candidates
from planner.grasp_problem import GraspProblem
from planner.objects.mjcf.reader import read_object
from planner.planning import plan
from planner.search.result import Status
from planner.task import make_task
from sim.validation.validation import validate
from tests.tools.commands import ASSETS

pytestmark = pytest.mark.slow

OBJECTS = sorted(path.parent.name for path in ASSETS.glob("*/*.xml"))


@pytest.mark.parametrize("fingers", [3, 4])
@pytest.mark.parametrize("name", OBJECTS)
def test_an_asset_plans_and_passes_in_mujoco(name: str, fingers: int) -> None:
    rigid_object = read_object(ASSETS / name / f"{name}.xml")
    task = make_task("gravity", rigid_object)
    candidates = make_candidates(rigid_object, "100", None, seed=0)
    grasp = plan(GraspProblem(rigid_object, task, candidates, fingers))
    assert grasp.status is Status.OPTIMAL
    validation = validate(rigid_object, grasp)
    assert validation.verdict, validation.reasons
