"""Soft fingers in the certified search: as enumeration finds, each proof checked, and where theory knows the answer."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from planner.contact_models.models import free_to_turn
from planner.contacts import Contacts
from planner.errors import CandidateError
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.search.certified import CertifiedSearch
from planner.search.exhaustive import exhaustive_search
from planner.search.paper import PaperSearch
from planner.search.problem import SearchProblem
from planner.search.result import Status
from planner.verification.bound_check import Claim, check_bound
from planner.verification.proof_check import certificate_of
from tests.strategies.force_problems import soft
from tests.strategies.soft_problems import soft_problem

SEEDS = range(240)


def best_pairs() -> SearchProblem:
    """Two opposite contacts on a ball of radius 1, pulled across by 1 N at a lever of 0.2."""
    contacts = Contacts(
        points=np.array([[-1.0, 0, 0], [1, 0, 0]]),
        normals=np.array([[1.0, 0, 0], [-1, 0, 0]]),
        friction=np.full(2, 0.5),
        torsion=np.full(2, 0.3),
    )
    wrench = np.array([[0, 0, -1.0, 0.2, 0, 0]])
    return SearchProblem(contacts=contacts, fingers=2, reference_point=np.zeros(3), wrenches=wrench)


def claim(problem: SearchProblem, bound: float) -> Claim:
    return Claim(problem.fingers, problem.reference_point, problem.wrenches, bound)


@pytest.mark.parametrize("part", range(8))
def test_the_search_finds_what_enumeration_finds_and_its_proof_checks(part: int) -> None:
    feasible = 0
    for seed in SEEDS[part::8]:
        problem = soft_problem(seed)
        best, found = exhaustive_search(problem), CertifiedSearch(gap=1e-4).run(problem)
        certificate = certificate_of(found)
        assert check_bound(certificate, claim(problem, found.lower_bound)).proven, seed
        if best is None:
            assert found.status is Status.INFEASIBLE, seed
            continue
        feasible += 1
        assert found.status is Status.OPTIMAL, seed
        assert best.rho * (1 - 1e-6) <= found.rho <= best.rho * (1 + 1.01e-4), seed
        assert found.lower_bound <= best.rho * (1 + 1e-7), seed
        assert not check_bound(certificate, claim(problem, 1.001 * best.rho)).proven, seed
    assert feasible >= 5


@pytest.mark.parametrize("seed", range(0, 40))
def test_the_forces_and_torques_found_are_those_of_the_textbook_model(seed: int) -> None:
    problem = soft_problem(seed)
    found = CertifiedSearch(gap=1e-4).run(problem).incumbent
    if found is None:
        pytest.skip("no grasp holds this one")
    contacts = problem.fingertips.subset(found.subset)
    solver = ReferenceForces(problem.fingers, 3, twisting=True)
    for row, wrench in enumerate(problem.wrenches):
        inner = ForceProblem(contacts=contacts, reference_point=problem.reference_point, wrench=wrench)
        assert found.phi[row] == pytest.approx(solver.solve(inner).phi, rel=2e-6)
        arms = contacts.points - problem.reference_point
        moment = np.cross(arms, found.forces[row]).sum(axis=0) + found.torques[row] @ contacts.normals
        assert np.abs(moment + wrench[3:]).max() <= 1e-6 * problem.length * found.rho
    assert not found.torques[:, contacts.torsions == 0].any()


def test_a_weight_beside_the_line_of_two_fingers_needs_what_the_ellipse_says() -> None:
    """Each finger carries 1/2 N across and twists 0.1 N m: f_n^2 = (0.5 / mu)^2 + (0.1 / gamma)^2."""
    best = exhaustive_search(best_pairs())
    assert best is not None
    press = np.hypot(0.5 / 0.5, 0.1 / 0.3)
    assert best.rho == pytest.approx(np.hypot(press, 0.5), rel=1e-7)
    np.testing.assert_allclose(np.abs(best.torques), 0.1, rtol=1e-6)


def test_without_torsional_friction_the_pair_cannot_hold_it_and_with_much_it_turns_freely_within_its_cones() -> None:
    """gamma to 0: infeasible, by more and more force on the way; gamma to infinity: the torque costs nothing."""
    problem = best_pairs()
    rho = []
    for torsion in (0.3, 0.03, 0.003, 0.0003):
        found = CertifiedSearch().run(replace(problem, contacts=soft(problem.contacts, torsion)))
        rho.append(found.rho)
    assert rho[1] == pytest.approx(np.hypot(np.hypot(1, 0.1 / 0.03), 0.5), rel=1e-6)
    assert all(after > 5 * before for before, after in pairwise(rho[1:]))
    hard = CertifiedSearch().run(replace(problem, contacts=soft(problem.contacts, 0.0)))
    assert hard.status is Status.INFEASIBLE
    free = CertifiedSearch().run(replace(problem, contacts=soft(problem.contacts, 300.0)))
    assert free.rho == pytest.approx(np.hypot(1, 0.5), rel=1e-5)


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_more_torsional_friction_never_raises_rho(seed: int) -> None:
    problem = soft_problem(seed)
    rho = []
    for factor in (0.5, 1.0, 2.0, 8.0):
        stronger = replace(problem, contacts=soft(problem.contacts, factor * problem.contacts.torsions))
        best = exhaustive_search(stronger)
        rho.append(np.inf if best is None else best.rho)
    assert all(after <= before * (1 + 1e-6) for before, after in pairwise(rho))


@pytest.mark.parametrize("seed", range(0, 60, 4))
def test_turning_and_scaling_everything_together_changes_nothing(seed: int) -> None:
    problem = soft_problem(seed)
    rng = np.random.default_rng(seed)
    rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    length, force = 10.0 ** rng.uniform(-2, 2, 2)
    contacts, (forces, moments) = problem.contacts, np.split(problem.wrenches, 2, axis=1)
    moved = replace(
        problem,
        contacts=Contacts(
            points=length * contacts.points @ rotation.T,
            normals=contacts.normals @ rotation.T,
            friction=contacts.friction,
            torsion=length * contacts.torsions,
        ),
        reference_point=length * rotation @ problem.reference_point,
        wrenches=force * np.hstack([forces @ rotation.T, length * moments @ rotation.T]),
    )
    before, after = CertifiedSearch(gap=1e-5).run(problem), CertifiedSearch(gap=1e-5).run(moved)
    assert before.status is after.status
    if before.incumbent is not None:
        assert after.rho == pytest.approx(force * before.rho, rel=3e-5)


def test_two_fingers_of_which_one_is_soft_are_not_free_to_turn() -> None:
    contacts = soft(soft_problem(0).contacts, 0.0)
    torsion = np.zeros(len(contacts))
    assert free_to_turn(contacts, 2)
    torsion[2:] = 0.01
    assert free_to_turn(soft(contacts, torsion), 2), "the first two are hard"
    torsion[1:] = 0.01
    assert not free_to_turn(soft(contacts, torsion), 2)
    assert not free_to_turn(contacts, 3)


def test_the_papers_search_refuses_what_the_paper_does_not_know() -> None:
    with pytest.raises(CandidateError, match="torsional friction"):
        PaperSearch().run(best_pairs())
