"""Planar grasps lifted into space need the same forces."""

import numpy as np
import pytest

from planner.arrays import Floats
from planner.candidates.choice import make_candidates
from planner.contacts import Contacts
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.grasp_problem import GraspProblem
from planner.grasps.lift import in_space, lift_contacts, lift_vectors, lift_wrenches
from planner.objects.planar.extrusion import Slab
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.task import make_task
from planner.verification.verify import verify
from tests.strategies.planar_objects import RECTANGLE, planar_object


def solved(contacts: Contacts, reference_point: Floats, wrench: Floats) -> float:
    solver = MinimaxForces(len(contacts), contacts.dimension)
    return solver.solve(ForceProblem(contacts=contacts, reference_point=reference_point, wrench=wrench)).phi


@pytest.mark.parametrize("fingers", [2, 3, 4])
def test_phi_is_the_same_in_the_plane_and_in_space(fingers: int) -> None:
    generator = np.random.default_rng(fingers)
    feasible = 0
    for _ in range(60):
        angles = generator.uniform(0, 2 * np.pi, fingers)
        outward = np.column_stack([np.cos(angles), np.sin(angles)])
        contacts = Contacts(
            points=outward * generator.uniform(0.5, 1.5, (fingers, 1)),
            normals=-outward,
            friction=generator.uniform(0.2, 1.5, fingers),
        )
        reference_point, wrench = generator.normal(size=2), generator.normal(size=3)
        planar = solved(contacts, reference_point, wrench)
        spatial = solved(lift_contacts(contacts), lift_vectors(reference_point), lift_wrenches(wrench))
        assert spatial == pytest.approx(planar, rel=1e-6)
        feasible += np.isfinite(planar)
    assert 5 < feasible < 60


def test_a_lifted_grasp_is_verified_like_any_grasp_in_space() -> None:
    planar = planar_object(RECTANGLE)
    grasp = plan(
        GraspProblem(planar, make_task("paper", planar), make_candidates(planar, "12", 0.5, seed=0), fingers=3)
    )
    slab, lifted = in_space(planar, grasp)
    assert isinstance(slab, Slab)
    assert lifted.rho == grasp.rho
    assert not any(check.fails for check in verify(grasp))
    assert not any(check.fails for check in verify(lifted))


def test_an_object_in_space_and_its_grasp_stay_as_they_are(prism: RigidObject) -> None:
    task = make_task("gravity", prism)
    grasp = plan(GraspProblem(prism, task, make_candidates(prism, "8", 0.5, seed=0), fingers=3))
    assert in_space(prism, grasp) == (prism, grasp)
