"""Presets in the plane."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from planner.errors import TaskError
from planner.objects.object_file import read_object_file
from planner.task import make_task
from planner.wrench_sets.presets import GRAVITY
from tests.strategies.planar_objects import HOOK, RECTANGLE, planar_object
from tests.tools.commands import ASSETS

WEIGHT = 0.05 * GRAVITY


@pytest.mark.parametrize("name", ["convex", "concave"])
def test_paper_contains_the_disc_times_the_interval_and_each_of_its_ten_facets_touches_it(name: str) -> None:
    planar = read_object_file(ASSETS / "planar" / f"{name}.toml")
    task = make_task("paper", planar)
    assert task.wrenches.shape == (16, 3)
    force = planar.mass * GRAVITY
    moment = float(np.abs(task.wrenches[:, 2]).max())
    hull = ConvexHull(task.wrenches / [force, force, moment]).equations
    facets = np.unique(np.round(hull, 6), axis=0)
    assert len(facets) == 10
    across = np.linalg.norm(facets[:, :2], axis=1) + np.abs(facets[:, 2])  # support of the disc times the interval
    np.testing.assert_allclose(across, -facets[:, 3], atol=1e-6)


def test_papers_moment_is_the_weight_at_four_fifths_of_the_way_to_the_nearest_corner() -> None:
    moments = make_task("paper", planar_object(RECTANGLE)).wrenches[:, 2]
    np.testing.assert_allclose(np.abs(moments), 0.8 * np.hypot(0.03, 0.02) * WEIGHT)
    hook = planar_object(HOOK)
    to_corners = min(np.hypot(*(hook.center_of_mass - corner)) for corner in HOOK)
    np.testing.assert_allclose(np.abs(make_task("paper", hook).wrenches[:, 2]), 0.8 * to_corners * WEIGHT)


def test_paper_may_be_taken_about_another_point(tmp_path: Path) -> None:
    path = tmp_path / "edge.toml"
    path.write_text('reference_point = [0.03, 0.0]\nset = {kind = "paper"}')
    task = make_task(str(path), planar_object(RECTANGLE))
    np.testing.assert_allclose(np.abs(task.wrenches[:, 2]), 0.8 * 0.02 * WEIGHT)


def test_gravity_contains_the_weight_at_every_center_in_a_tenth_of_the_shortest_extent() -> None:
    vertices = make_task("gravity", planar_object(RECTANGLE)).wrenches
    generator = np.random.default_rng(0)
    angles, at = generator.uniform(0, 2 * np.pi, (2, 2000))
    forces, centers = (size * np.column_stack([np.cos(a), np.sin(a)]) for size, a in ((WEIGHT, angles), (0.004, at)))
    moments = centers[:, 0] * forces[:, 1] - centers[:, 1] * forces[:, 0]
    scale = np.array([WEIGHT, WEIGHT, 0.004 * WEIGHT])
    hull = ConvexHull(vertices / scale).equations
    assert (np.column_stack([forces, moments]) / scale @ hull[:, :-1].T + hull[:, -1] <= 1e-9).all()
    assert np.abs(vertices[:, 2]).max() == pytest.approx(0.004 * WEIGHT)


def test_axes6_pushes_along_both_axes_of_the_plane() -> None:
    wrenches = make_task("axes6", planar_object(RECTANGLE)).wrenches
    assert sorted(wrenches.tolist()) == [[-0.5, 0, 0], [0, -0.5, 0], [0, 0.5, 0], [0.5, 0, 0]]


def test_a_task_file_for_space_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "space.toml"
    path.write_text('set = {kind = "single", wrench = [0, 0, -1, 0, 0, 0]}')
    with pytest.raises(TaskError, match=r"shape \(1, 6\).*\(1 or more, 3\)"):
        make_task(str(path), planar_object(RECTANGLE))
    path.write_text('reference_point = [0, 0, 0]\nset = {kind = "single", wrench = [0, -1, 0]}')
    with pytest.raises(TaskError, match="reference_point has shape"):
        make_task(str(path), planar_object(RECTANGLE))


def test_a_task_file_for_the_plane_is_taken(tmp_path: Path) -> None:
    path = tmp_path / "plane.toml"
    path.write_text('set = {kind = "cylinder", force = 2, moment = 0.1, dimension = 2}')
    assert make_task(str(path), planar_object(RECTANGLE)).wrenches.shape == (16, 3)
