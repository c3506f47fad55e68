"""Presets: required external force sets sized by the object."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from planner.errors import TaskError
from planner.objects.mjcf.reader import read_object
from planner.wrench_sets.presets import GRAVITY, PRESETS, Axes6, Gravity, Paper
from tests.strategies.bricks import brick

ASSETS = Path(__file__).resolve().parents[3] / "assets"


def test_paper_is_the_box_of_case_three() -> None:
    """In the paper's units: forces 0.16, moments 0.8 * (2 sqrt 2 / 3) * 0.16 [N cm]."""
    prism = read_object(ASSETS / "prism" / "prism.xml")
    vertices = Paper().for_object(prism, prism.center_of_mass).vertices()
    moment = 0.8 * 2 * np.sqrt(2) / 3 * 0.16 * 0.01
    assert len(vertices) == 64
    np.testing.assert_allclose(np.abs(vertices), np.tile([*3 * [0.16], *3 * [moment]], (64, 1)), rtol=1e-6)


def test_papers_moment_shrinks_as_the_reference_point_nears_a_facet() -> None:
    prism = read_object(ASSETS / "prism" / "prism.xml")
    vertices = Paper().for_object(prism, np.array([0.0, 0.0, 0.009])).vertices()
    assert np.abs(vertices[:, 3:]).max() == pytest.approx(0.8 * 0.001 * 0.16, rel=1e-4)


@pytest.mark.parametrize("radius", [0.0, 0.003, 0.2])
def test_gravity_contains_the_weight_at_every_center_in_the_ball(radius: float) -> None:
    """The facets of the hull, found without the set's own code, hold every (f, r x f)."""
    vertices = Gravity(radius=radius).for_object(brick(), np.zeros(3)).vertices()
    rng = np.random.default_rng(0)
    forces = rng.normal(size=(3000, 3))
    forces *= 0.5 * GRAVITY / np.linalg.norm(forces, axis=1, keepdims=True)
    centers = rng.normal(size=(3000, 3))
    centers *= radius / np.linalg.norm(centers, axis=1, keepdims=True)
    wrenches = np.hstack([forces, np.cross(centers, forces)])
    axes = np.flatnonzero(vertices.any(axis=0))
    hull = ConvexHull(vertices[:, axes] / vertices[:, axes].max(axis=0)).equations
    assert (wrenches[:, axes] / vertices[:, axes].max(axis=0) @ hull[:, :-1].T + hull[:, -1] <= 1e-9).all()


def test_gravity_takes_a_tenth_of_the_shortest_extent_where_no_radius_is_given() -> None:
    stated = Gravity(radius=0.005).for_object(brick(), np.zeros(3)).vertices()
    taken = Gravity().for_object(brick(), np.zeros(3)).vertices()
    assert taken.shape == (72, 6)
    np.testing.assert_allclose(taken, stated)


def test_axes6_pushes_ten_times_the_mass_along_each_axis() -> None:
    vertices = Axes6().for_object(brick(), np.zeros(3)).vertices()
    expected = {(*(5.0 * sign * np.eye(3)[axis]), 0.0, 0.0, 0.0) for axis in range(3) for sign in (1, -1)}
    assert {tuple(np.round(vertex, 12)) for vertex in vertices} == expected
    assert len(vertices) == 6


@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
@pytest.mark.parametrize("mass", [0.0, float("nan")])
def test_an_object_without_mass_has_no_preset(preset: type[Gravity], mass: float) -> None:
    with pytest.raises(TaskError, match="the object has no mass"):
        preset().for_object(brick(mass), np.zeros(3))


@pytest.mark.parametrize("value", [-0.1, float("nan"), float("inf")])
def test_malformed_parameters_are_refused(value: float) -> None:
    with pytest.raises(TaskError, match="radius must be finite and not negative"):
        Gravity(radius=value)
    with pytest.raises(TaskError, match="acceleration must be finite and positive"):
        Axes6(acceleration=value)
