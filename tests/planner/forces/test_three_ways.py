"""Subproblem 2 three ways: Clarabel in contact frames, CVXPY with norms, CVXPY with the paper's two matrices."""

from dataclasses import replace

import numpy as np
import pytest

from planner.contact_models.soft_finger import SOFT_FINGER
from planner.contacts import Contacts
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.forces.semidefinite import SemidefiniteForces
from tests.strategies.force_problems import SHAPES, random_problem, soft_problem
from tests.tools.lanes import first_fast

TRIALS = 10
BEYOND_ANY_GRASP = 1e5
"""A direction that proves this many times the wrench proves, to a solver's accuracy, that there are no forces."""


@pytest.mark.parametrize(("fingers", "dimension"), first_fast(SHAPES, fast=5))
@pytest.mark.parametrize("feasible", [True, False])
def test_all_three_find_the_same_phi_or_prove_that_there_is_none(fingers: int, dimension: int, feasible: bool) -> None:
    """Every contact has its own friction; of the arbitrary wrenches two fingers balance few."""
    rng = np.random.default_rng([fingers, dimension, feasible])
    solvers = [solver(fingers, dimension) for solver in (MinimaxForces, ReferenceForces, SemidefiniteForces)]
    unbalanced = 0
    for _ in range(TRIALS):
        problem = random_problem(rng, fingers, dimension, feasible=feasible)
        clarabel, norms, matrices = (solver.solve(problem) for solver in solvers)
        assert norms.phi == pytest.approx(clarabel.phi, rel=1e-6)
        assert matrices.phi == pytest.approx(clarabel.phi, rel=1e-6)
        assert clarabel.feasible or not feasible
        unbalanced += not clarabel.feasible
        for solution in (clarabel, norms, matrices):
            assert solution.feasible == np.isfinite(solution.phi)
            if solution.feasible:
                assert solution.balance_residual() < 1e-6
                assert solution.cone_residual() < 1e-6
                assert solution.gap() < 1e-6
            else:
                assert solution.lower_bound() > BEYOND_ANY_GRASP * np.abs(problem.wrench).max()
    if not feasible and fingers == 2:
        assert unbalanced > 0  # the second half of the claim was tried


@pytest.mark.parametrize(("fingers", "dimension"), first_fast(SHAPES, fast=5))
def test_fingers_of_different_strength_are_capped_at_their_own_share(fingers: int, dimension: int) -> None:
    """All three agree; each force is at most s_i phi, one is as large; the direction proves it best."""
    rng = np.random.default_rng([fingers, dimension])
    solvers = [solver(fingers, dimension) for solver in (MinimaxForces, ReferenceForces, SemidefiniteForces)]
    for _ in range(TRIALS):
        even = random_problem(rng, fingers, dimension, feasible=True)
        strength = 10.0 ** rng.uniform(-1, 1, size=fingers)
        problem = replace(even, contacts=replace(even.contacts, strength=strength))
        phi = solvers[0].solve(problem).phi
        for solution in (solver.solve(problem) for solver in solvers):
            assert solution.phi == pytest.approx(phi, rel=1e-6)
            assert (np.linalg.norm(solution.forces, axis=1) / strength).max() == pytest.approx(phi, rel=1e-6)
            assert solution.balance_residual() < 1e-6
            assert solution.cone_residual() < 1e-6 * strength.max()
            assert solution.gap() < 1e-6
        twice = replace(even, contacts=replace(even.contacts, strength=2 * strength))
        assert solvers[0].solve(twice).phi == pytest.approx(phi / 2, rel=1e-6)


@pytest.mark.parametrize("solver", [MinimaxForces, ReferenceForces, SemidefiniteForces])
def test_supports_share_a_weight_by_their_strengths(solver: type[MinimaxForces] | type[ReferenceForces]) -> None:
    """Three supports in line under a weight, the outer two alike: phi = W / (s_1 + s_2 + s_3)."""
    contacts = Contacts(
        points=np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]),
        normals=np.tile([0.0, 1.0], (3, 1)),
        friction=np.full(3, 0.5),
        strength=np.array([1.0, 0.5, 1.0]),
    )
    problem = ForceProblem(contacts=contacts, reference_point=np.zeros(2), wrench=np.array([0.0, -5.0, 0.0]))
    solution = solver(3, 2).solve(problem)
    assert solution.phi == pytest.approx(5 / 2.5, rel=1e-6)
    np.testing.assert_allclose(solution.forces, [[0, 2], [0, 1], [0, 2]], atol=1e-5)


def test_the_matrices_are_those_of_the_paper() -> None:
    """F and P as printed; their eigenvalues, phi ± |f| and phi, mu n ± |t| and mu n, make them cap and cone."""
    import cvxpy as cp

    force, phi, limit = np.array([3.0, 0.4, -1.2]), 3.5, 1.5
    constraints = SemidefiniteForces(2, 3).inequalities(
        cp.Constant(phi), cp.Constant(force), cp.Constant(limit), cp.Constant(force[1:])
    )
    F, P = (np.asarray(constraint.args[0].value) for constraint in constraints)
    assert pytest.approx(np.array([[3.5, 0, 0, 3], [0, 3.5, 0, 0.4], [0, 0, 3.5, -1.2], [3, 0.4, -1.2, 3.5]])) == F
    assert pytest.approx(np.array([[1.5, 0, 0.4], [0, 1.5, -1.2], [0.4, -1.2, 1.5]])) == P
    norm, slip = np.linalg.norm(force), np.linalg.norm(force[1:])
    assert np.linalg.eigvalsh(F) == pytest.approx([phi - norm, phi, phi, phi + norm])
    assert np.linalg.eigvalsh(P) == pytest.approx([limit - slip, limit, limit + slip])


@pytest.mark.parametrize("solver", [MinimaxForces, ReferenceForces, SemidefiniteForces])
def test_a_palm_carries_a_weight_alone_while_the_finger_above_stays_off(
    solver: type[MinimaxForces | ReferenceForces | SemidefiniteForces],
) -> None:
    """A finger that can only push down does not help: phi is the weight."""
    contacts = Contacts(
        points=np.array([[0.0, 0.0, -0.02], [0.0, 0.0, 0.02]]),
        normals=np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]),
        friction=np.array([0.5, 0.9]),
    )
    problem = ForceProblem(contacts=contacts, reference_point=np.zeros(3), wrench=np.array([0, 0, -7.0, 0, 0, 0]))
    assert solver(2, 3).solve(problem).phi == pytest.approx(7.0, rel=1e-6)


@pytest.mark.parametrize("fingers", [1, 2, 3, 4])
@pytest.mark.parametrize("feasible", [True, False])
def test_all_three_agree_on_fingers_that_twist(fingers: int, feasible: bool) -> None:
    rng = np.random.default_rng([fingers, feasible, 7])
    twisting = 0
    clarabel = MinimaxForces(fingers, 3, SOFT_FINGER)
    references = [ReferenceForces(fingers, 3, twisting=True), SemidefiniteForces(fingers, 3, twisting=True)]
    for _ in range(TRIALS):
        problem = soft_problem(rng, fingers, feasible=feasible)
        fast = clarabel.solve(problem)
        for solution in (fast, *(solver.solve(problem) for solver in references)):
            assert solution.phi == pytest.approx(fast.phi, rel=1e-5)
            assert solution.feasible or not feasible
            if solution.feasible:
                assert solution.balance_residual() < 1e-6
                assert solution.cone_residual() < 1e-6
                assert solution.gap() < 1e-5
                twisting += bool(np.abs(solution.torques).max() > 0)
                assert not solution.torques[problem.contacts.torsions == 0].any()
    if feasible:
        assert twisting > TRIALS
