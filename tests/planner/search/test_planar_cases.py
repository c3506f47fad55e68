"""Our planar cases: every search finds the same optimum, and two fingers need what statics says."""

from pathlib import Path

import numpy as np
import pytest

from planner.arrays import Floats
from planner.candidates.choice import make_candidates
from planner.grasp_problem import GraspProblem
from planner.objects.object_file import read_object_file
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.search.exhaustive import exhaustive_search
from planner.search.paper import PaperSearch
from planner.search.problem import SearchProblem
from planner.search.result import Status
from planner.task import make_task
from tests.strategies.planar_objects import RECTANGLE, planar_object
from tests.tools.commands import ASSETS
from tests.tools.lanes import first_fast

GAP = 1e-4


def problem(name: str, candidates: int, fingers: int, friction: float) -> SearchProblem:
    planar = read_object_file(ASSETS / "planar" / f"{name}.toml")
    task = make_task("paper", planar)
    return SearchProblem(
        contacts=make_candidates(planar, str(candidates), friction, seed=0).contacts,
        fingers=fingers,
        reference_point=task.reference_point,
        wrenches=task.wrenches,
    )


@pytest.mark.parametrize("friction", first_fast([0.3, 0.1, 0.5]))
@pytest.mark.parametrize(
    ("name", "candidates", "fingers"),
    first_fast([("convex", 56, 2), ("convex", 16, 3), ("concave", 86, 2), ("concave", 20, 3)], fast=2),
)
def test_all_searches_agree(name: str, candidates: int, fingers: int, friction: float) -> None:
    """Three fingers on fewer candidates than two, because enumeration visits every combination."""
    instance = problem(name, candidates, fingers, friction)
    certified = CertifiedSearch(gap=GAP).run(instance)
    best = exhaustive_search(instance)
    assert best is not None
    assert certified.status is Status.OPTIMAL
    assert certified.rho == pytest.approx(best.rho, rel=2 * GAP)
    assert certified.lower_bound <= best.rho * (1 + 1e-7)
    for bound in ("relaxation", "subproblem 2"):
        paper = PaperSearch(bound=bound, epsilon=GAP).run(instance)
        assert paper.rho == pytest.approx(best.rho, rel=2 * GAP)


@pytest.mark.parametrize("name", ["convex", "concave"])
def test_friction_and_a_third_finger_never_cost_force(name: str) -> None:
    count = {"convex": 56, "concave": 86}[name]
    rho = np.array(
        [
            [CertifiedSearch(gap=1e-3).run(problem(name, count, fingers, mu)).rho for mu in (0.1, 0.3, 0.5)]
            for fingers in (2, 3)
        ]
    )
    assert (np.diff(rho, axis=0) < 0).all()
    assert (np.diff(rho, axis=1) < 0).all()


def antipodal_phi(half_width: float, friction: float, wrench: Floats) -> float:
    """Least largest force of fingers at (a, 0) and (-a, 0) that push inward, by hand.

    With pushes n_1, n_2 and forces t_1, t_2 along y:  n_2 - n_1 = -X,  t_1 + t_2 = -Y,  a (t_1 - t_2) = -M. Both t are
    determined, and n_2 = n_1 - X, so both forces grow with n_1, whose least value is set by the cones.
    """
    x, y, moment = wrench
    right, left = (-y - moment / half_width) / 2, (-y + moment / half_width) / 2
    push = max(abs(right) / friction, abs(left) / friction + x)
    return max(float(np.hypot(push, right)), float(np.hypot(push - x, left)))


def test_two_opposite_fingers_need_what_statics_says(tmp_path: Path) -> None:
    planar = planar_object(RECTANGLE)
    points, task = tmp_path / "opposite.csv", tmp_path / "load.toml"
    points.write_text("0.03,0\n-0.03,0\n")
    tangential = 2.0 / 2 * np.sqrt(1 + 1 / 0.4**2)
    for wrench, expected in (([0.0, 2.0, 0.0], tangential), ([0.0, 0.0, 0.06], tangential), ([3.0, 0.0, 0.0], 3.0)):
        assert antipodal_phi(0.03, 0.4, np.array(wrench)) == pytest.approx(expected)
        task.write_text(f'set = {{kind = "single", wrench = {wrench}}}')
        candidates = make_candidates(planar, str(points), 0.4, seed=0)
        grasp = plan(GraspProblem(planar, make_task(str(task), planar), candidates, fingers=2))
        assert grasp.rho == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("friction", [0.1, 0.3, 0.5])
def test_two_opposite_fingers_need_what_statics_says_for_the_papers_set(friction: float, tmp_path: Path) -> None:
    planar = planar_object(RECTANGLE)
    points = tmp_path / "opposite.csv"
    points.write_text("0.03,0\n-0.03,0\n")
    task = make_task("paper", planar)
    grasp = plan(GraspProblem(planar, task, make_candidates(planar, str(points), friction, seed=0), fingers=2))
    expected = [antipodal_phi(0.03, friction, wrench) for wrench in task.wrenches]
    np.testing.assert_allclose(grasp.phi, expected, rtol=1e-6)
