"""The inner problem: two solvers, closed forms, the paper's printed values, and proofs checked by hand."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from planner.contacts import Contacts, grasp_maps
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem, ForceSolution
from planner.forces.reference import ReferenceForces
from planner.wrench_sets.box import WrenchBox
from tests.strategies.force_problems import SEEDS, SHAPES, cone_forces, random_contacts, random_problem
from tests.tools.lanes import first_fast

SOLVERS = {shape: MinimaxForces(*shape) for shape in SHAPES}  # reused, as in the search


def solve(problem: ForceProblem) -> ForceSolution:
    return SOLVERS[len(problem.contacts), problem.contacts.dimension].solve(problem)


@pytest.mark.parametrize(("fingers", "dimension"), first_fast(SHAPES, fast=5))
def test_the_fast_solver_agrees_with_the_textbook_formulation(fingers: int, dimension: int) -> None:
    rng = np.random.default_rng(100 * fingers + dimension)
    reference = ReferenceForces(fingers, dimension)
    for trial in range(30):
        problem = random_problem(rng, fingers, dimension, feasible=trial % 2 == 0)
        fast, slow = solve(problem), reference.solve(problem)
        assert fast.feasible == slow.feasible
        assert fast.feasible or trial % 2 == 1
        assert fast.phi == pytest.approx(slow.phi, rel=1e-6)


@pytest.mark.parametrize(("fingers", "dimension"), SHAPES)
@settings(max_examples=25, deadline=None, derandomize=True)
@given(seed=SEEDS)
def test_a_solution_balances_stays_in_its_cones_and_is_proved_best(fingers: int, dimension: int, seed: int) -> None:
    problem = random_problem(np.random.default_rng(seed), fingers, dimension, feasible=True)
    solution = solve(problem)
    assert solution.feasible
    assert solution.balance_residual() < 1e-8
    assert solution.cone_residual() < 1e-6
    assert solution.lower_bound() <= solution.phi * (1 + 1e-6)
    assert solution.gap() < 1e-6


@settings(max_examples=100, deadline=None, derandomize=True)
@given(seed=SEEDS, shape=st.sampled_from(SHAPES))
def test_no_direction_proves_more_than_phi(seed: int, shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(seed)
    best = solve(random_problem(rng, *shape, feasible=True))
    spread = np.abs(best.direction) * rng.normal(size=len(best.direction))
    other = ForceSolution(
        problem=best.problem,
        feasible=True,
        forces=best.forces,
        torques=best.torques,
        phi=best.phi,
        direction=best.direction + rng.choice([1e-3, 0.1, 1.0]) * spread,
    )
    assert other.lower_bound() <= best.phi * (1 + 1e-6)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(seed=SEEDS, shape=st.sampled_from(SHAPES))
def test_the_direction_of_an_infeasible_problem_separates_it_from_every_cone_force(
    seed: int, shape: tuple[int, int]
) -> None:
    rng = np.random.default_rng(seed)
    problem = random_problem(rng, *shape, feasible=False)
    solution = solve(problem)
    assume(not solution.feasible)
    assert np.isinf(solution.phi)
    assert np.isnan(solution.forces).all()
    load = -float(solution.direction @ problem.wrench)
    assert load > 0
    maps = grasp_maps(problem.contacts.points, problem.reference_point)
    scale = np.ones(len(problem.wrench))
    scale[shape[1] :] /= problem.length
    size = np.linalg.norm(scale * problem.wrench)
    for _ in range(20):
        made = np.einsum("iDd,id->D", maps, cone_forces(rng, problem.contacts))
        assert solution.direction @ made < 1e-6 * load / size


@pytest.mark.parametrize("solver", [MinimaxForces, ReferenceForces])
def test_a_squeeze_is_limited_by_the_smaller_friction(solver: type[MinimaxForces | ReferenceForces]) -> None:
    """Two fingers face each other and hold W between them: t = W/2 each, n = t / min mu."""
    for friction in ([0.2, 0.9], [0.9, 0.2]):
        contacts = Contacts(
            points=np.array([[-0.03, 0.0], [0.03, 0.0]]),
            normals=np.array([[1.0, 0.0], [-1.0, 0.0]]),
            friction=np.array(friction),
        )
        problem = ForceProblem(contacts=contacts, reference_point=np.zeros(2), wrench=np.array([0.0, -5.0, 0.0]))
        assert solver(2, 2).solve(problem).phi == pytest.approx(2.5 * np.hypot(1, 1 / 0.2), rel=1e-7)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(seed=SEEDS, shape=st.sampled_from(SHAPES))
def test_phi_turns_scales_and_permutes_with_the_problem(seed: int, shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(seed)
    problem = random_problem(rng, *shape, feasible=True)
    contacts, dimension = problem.contacts, shape[1]
    if dimension == 3:
        turn = np.asarray(Rotation.from_rotvec(rng.normal(size=3)).as_matrix())
    else:
        turn = np.asarray(Rotation.from_rotvec([0, 0, rng.normal()]).as_matrix())[:2, :2]
    length, force = 10.0 ** rng.uniform(-3, 3, size=2)
    order = rng.permutation(shape[0])
    forces, moments = problem.wrench[:dimension], problem.wrench[dimension:]
    turned = turn @ moments if dimension == 3 else moments
    image = ForceProblem(
        contacts=Contacts(
            points=length * contacts.points[order] @ turn.T,
            normals=contacts.normals[order] @ turn.T,
            friction=contacts.friction[order],
        ),
        reference_point=length * turn @ problem.reference_point,
        wrench=force * np.concatenate([turn @ forces, length * turned]),
    )
    assert solve(image).phi == pytest.approx(force * solve(problem).phi, rel=1e-6)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(seed=SEEDS, shape=st.sampled_from(SHAPES))
def test_more_friction_at_one_contact_never_costs_force(seed: int, shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(seed)
    problem = random_problem(rng, *shape, feasible=True)
    friction = problem.contacts.friction.copy()
    friction[rng.integers(shape[0])] *= 1.5
    contacts = Contacts(points=problem.contacts.points, normals=problem.contacts.normals, friction=friction)
    rougher = ForceProblem(contacts=contacts, reference_point=problem.reference_point, wrench=problem.wrench)
    assert solve(rougher).phi <= solve(problem).phi * (1 + 1e-6)


def test_no_wrench_needs_no_force() -> None:
    contacts = random_contacts(np.random.default_rng(0), 3, 3)
    solution = solve(ForceProblem(contacts=contacts, reference_point=np.zeros(3), wrench=np.zeros(6)))
    assert solution.phi == pytest.approx(0, abs=1e-7)


@pytest.mark.parametrize(
    ("points", "printed"),
    [
        ([[2 / 9, -4 / 3, 0], [2 / 3, 2 / 3, 0], [-4 / 3, 2 / 9, 0]], 0.66900),
        ([[0, -4 / 3, 0], [2 / 3, 2 / 3, 0], [-4 / 3, 0, 0]], 0.71843),
    ],
)
def test_the_papers_prism_needs_the_forces_the_paper_prints(points: list[list[float]], printed: float) -> None:
    """Case III in the paper's units: its optimum 0.669, and 0.718 at the feet of the perpendiculars."""
    diagonal = -np.sqrt(0.5)
    contacts = Contacts(
        points=np.array(points),
        normals=np.array([[0, 1, 0], [diagonal, diagonal, 0], [1, 0, 0]]),
        friction=np.full(3, 0.3),
    )
    weight, gamma = 16 * 0.01, 2 * np.sqrt(2) / 3
    required = WrenchBox(force=3 * (weight,), moment=3 * (0.8 * gamma * weight,)).vertices()
    phis = [
        solve(ForceProblem(contacts=contacts, reference_point=np.zeros(3), wrench=wrench)).phi for wrench in required
    ]
    assert max(phis) == pytest.approx(printed, abs=6e-6)
