"""Inside W_R everything holds, at rest and turning; outside it does not."""

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest

from sim.trial.experiment import Experiment, set_up
from sim.trial.prediction import predicted_caps
from sim.trial.protocol import ACTIVE
from sim.validation.beyond import Loads, measure_beyond, measure_paths
from sim.validation.wrench_samples import boundary_wrenches, interior_wrenches, reach, rotating_forces
from tests.strategies.planned_grasps import prism

CUBE = np.array(list(product((-1.0, 1.0), repeat=6))) * np.array([2, 1, 3, 0.1, 0.2, 0.3])
"""|w_k| <= (2, 1, 3, 0.1, 0.2, 0.3)_k."""


def experiment_of(rho_factor: float) -> Experiment:
    """The prism with the cap counted from another rho."""
    grasp = prism().loaded
    return set_up(grasp, ACTIVE, newton=rho_factor * grasp.rho)


@cache
def beyond_of(rho_factor: float) -> tuple[Loads, ...]:
    return measure_beyond(experiment_of(rho_factor))


@pytest.mark.slow
def test_wrenches_and_turning_loads_in_the_set_are_held_and_what_is_outside_is_not() -> None:
    interior, boundary, paths, outside = beyond_of(1.0)
    assert (interior.held, boundary.held, paths.held) == (32, 32, 6) == (interior.loads, boundary.loads, paths.loads)
    assert (outside.held, outside.loads) == (0, 1)
    assert not any(loads.objection() or loads.doubt() for loads in beyond_of(1.0))


def test_a_turning_load_is_held_above_the_largest_cap_predicted_on_its_path_and_lost_below() -> None:
    experiment = experiment_of(1.0)
    path = rotating_forces(experiment.grasp.wrenches)[:1]
    needed = predicted_caps(experiment.grasp.contacts, np.zeros(3), path[0]).max() * experiment.units.force
    assert measure_paths(experiment, path, 1.02 * needed).held.all()
    assert not measure_paths(experiment, path, 0.9 * needed).held.any()


@pytest.mark.slow
def test_loads_that_were_not_held_speak_against_rho() -> None:
    _, boundary, _, _ = beyond_of(1.0)
    objection = replace(boundary, held=boundary.held - 1).objection()
    assert objection is not None and objection.startswith("1 of 32 wrenches on the boundary of W_R were not held")


def test_an_outside_that_is_held_raises_a_doubt() -> None:
    *_, outside = beyond_of(1.0)
    doubt = replace(outside, held=1).doubt()
    assert doubt is not None and "cannot fail" in doubt


def test_boundary_wrenches_touch_a_side_of_the_box_and_interior_ones_do_not() -> None:
    half = CUBE.max(axis=0)
    rng = np.random.default_rng(0)
    np.testing.assert_allclose(np.abs(boundary_wrenches(CUBE, 20, rng) / half).max(axis=1), 1, atol=1e-6)
    assert (np.abs(interior_wrenches(CUBE, 200, rng) / half).max(axis=1) < 1).all()


def test_the_reach_of_a_direction_that_the_set_does_not_span_is_zero() -> None:
    flat = np.hstack([CUBE[:, :3], np.zeros((64, 3))])
    assert reach(flat, np.zeros(6), np.array([1.0, 0, 0, 0, 0, 0])) == 2
    assert reach(flat, np.zeros(6), np.array([1.0, 0, 0, 1, 0, 0])) == 0


def test_turning_gravity_is_the_largest_circle_of_forces_in_each_plane() -> None:
    loops = rotating_forces(CUBE)
    np.testing.assert_allclose(np.linalg.norm(loops[:, :, :3], axis=2), np.tile([[1.0], [2.0], [1.0]], 25), atol=1e-6)
    np.testing.assert_allclose(loops[:, :, 3:], 0, atol=1e-9)
    np.testing.assert_allclose(loops[:, 0], loops[:, -1], atol=1e-9)
    assert rotating_forces(CUBE[:1]).shape == (0, 25, 6)
