"""The units of the experiment, and the grasps that have none."""

import numpy as np
import pytest

from planner.contacts import Contacts, grasp_maps
from planner.errors import SimulationError
from sim.scene.units import units_of

POINTS = np.array([(0.3, 0.1, 0.0), (-0.2, 0.0, 0.1)])
CONTACTS = Contacts(points=POINTS, normals=np.array([(1.0, 0, 0), (0, 1.0, 0)]), friction=np.ones(2))
ORIGIN = np.array([0.1, 0.0, 0.0])


def test_the_farthest_contact_is_at_the_reach_and_rho_is_one_newton() -> None:
    units = units_of(CONTACTS, ORIGIN, rho=4.0, reach=0.05)
    assert np.linalg.norm(units.points(POINTS), axis=1).max() == pytest.approx(0.05)
    assert 4.0 * units.force == pytest.approx(1.0)


def test_wrenches_of_mapped_forces_at_mapped_points_are_the_mapped_wrenches() -> None:
    units = units_of(CONTACTS, ORIGIN, rho=4.0, reach=0.05)
    forces = np.array([(1.0, 2.0, 3.0), (-2.0, 0.5, 1.0)])
    wrench = np.einsum("iDd,id->D", grasp_maps(POINTS, ORIGIN), forces)
    mapped = np.einsum("iDd,id->D", grasp_maps(units.points(POINTS), np.zeros(3)), units.force * forces)
    np.testing.assert_allclose(units.wrenches(wrench), mapped)


@pytest.mark.parametrize("rho", [0.0, -1.0, np.inf, np.nan])
def test_a_rho_that_is_no_force_is_refused(rho: float) -> None:
    with pytest.raises(SimulationError, match="rho is"):
        units_of(CONTACTS, ORIGIN, rho=rho, reach=0.05)


def test_a_planar_grasp_is_refused() -> None:
    planar = Contacts(points=POINTS[:, :2], normals=np.eye(2), friction=np.ones(2))
    with pytest.raises(SimulationError, match="planar"):
        units_of(planar, ORIGIN[:2], rho=1.0, reach=0.05)


def test_contacts_all_at_the_reference_point_are_refused() -> None:
    lone = CONTACTS.subset(np.array([0]))
    with pytest.raises(SimulationError, match="away from the reference point"):
        units_of(lone, POINTS[0], rho=1.0, reach=0.05)
