"""The Relaxed Problem: its cone contains the friction cone, its phi bounds Subproblem 2's, and how closely."""

import inspect

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog, nnls

from planner.contacts import Contacts, contact_frames, grasp_maps
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.forces.relaxation import OPTIONS, SIDES, RelaxedForces, cone_edges
from tests.strategies.force_problems import SEEDS, SHAPES, random_problem

RELAXED = {shape: RelaxedForces(*shape) for shape in SHAPES}
EXACT = {shape: MinimaxForces(*shape) for shape in SHAPES}


def relaxed_phi(problem: ForceProblem, sides: int = SIDES) -> float:
    contacts = problem.contacts
    shape = len(contacts), contacts.dimension
    solver = RELAXED[shape] if sides == SIDES else RelaxedForces(*shape, sides)
    edges = cone_edges(contacts.normals, contacts.friction, sides)
    maps = grasp_maps(contacts.points, problem.reference_point)
    return solver.solve_arrays(maps, edges, problem.wrench, problem.length)


def printed_program(problem: ForceProblem) -> float:
    """Eq. (9) as printed, in another interface and with another algorithm (interior point)."""
    contacts = problem.contacts
    edges = cone_edges(contacts.normals, contacts.friction)
    fingers, dimension, sides = edges.shape
    scale = np.r_[np.ones(dimension), np.full(len(problem.wrench) - dimension, 1 / problem.length)]
    load = scale * problem.wrench
    maps = scale[:, None] * grasp_maps(contacts.points, problem.reference_point)
    norms = np.zeros((fingers * dimension, fingers * sides))
    for finger in range(fingers):
        norms[finger * dimension :, finger * sides :][:dimension, :sides] = edges[finger]
    phi = np.ones((len(norms), 1))
    program = linprog(
        np.r_[np.zeros(fingers * sides), 1.0],
        A_ub=np.block([[norms, -phi], [-norms, -phi]]),
        b_ub=np.zeros(2 * len(norms)),
        A_eq=np.c_[np.concatenate(list(maps @ edges), axis=1), np.zeros(len(load))],
        b_eq=-load / np.abs(load).max(),
        method="highs-ipm",
    )
    return float(program.fun * np.abs(load).max()) if program.status == 0 else np.inf


@settings(max_examples=60, deadline=None, derandomize=True)
@given(seed=SEEDS, sides=st.sampled_from([3, 4, 8, 16]))
def test_every_force_in_the_round_cone_is_a_sum_of_edges(seed: int, sides: int) -> None:
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    friction = rng.uniform(0.05, 2.0)
    edges = cone_edges(normal[None], np.array([friction]), sides)[0]
    angle = rng.uniform(0, 2 * np.pi)
    on_the_surface = contact_frames(normal[None])[0] @ [1.0, friction * np.cos(angle), friction * np.sin(angle)]
    assert nnls(edges, on_the_surface)[1] < 1e-12


@pytest.mark.parametrize("sides", [3, 4, 8, 16, 64])
def test_edges_leave_the_round_cone_by_one_over_the_cosine_of_half_a_side(sides: int) -> None:
    """So the flats touch it: no smaller L-sided cone contains it, and more sides come closer."""
    friction = np.array([0.1, 0.7])
    normals = np.array([[0.0, 0.6, 0.8], [1.0, 0.0, 0.0]])
    edges = cone_edges(normals, friction, sides)
    press = np.einsum("id,idk->ik", normals, edges)
    slip = np.linalg.norm(edges - press[:, None] * normals[:, :, None], axis=1)
    assert np.linalg.norm(edges, axis=1) == pytest.approx(1.0)
    assert slip / press == pytest.approx(np.repeat(friction[:, None] / np.cos(np.pi / sides), sides, axis=1))


def test_the_two_edges_of_the_plane_are_those_of_the_cone() -> None:
    angle = np.arctan(0.4)
    edges = cone_edges(np.array([[0.0, 1.0]]), np.array([0.4]))[0]
    assert np.sort(edges, axis=1) == pytest.approx(np.array([[-np.sin(angle), np.sin(angle)], 2 * [np.cos(angle)]]))


def test_sixteen_sides_are_the_default_as_in_the_paper() -> None:
    assert SIDES == 16
    assert inspect.signature(RelaxedForces).parameters["sides"].default == SIDES
    assert cone_edges(np.eye(3), np.ones(3)).shape == (3, 3, 16)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_divided_program_has_the_value_of_the_printed_one(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(shape)
    for trial in range(12):
        problem = random_problem(rng, *shape, feasible=trial % 3 > 0)
        assert relaxed_phi(problem) == pytest.approx(printed_program(problem), rel=1e-6)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(seed=SEEDS, shape=st.sampled_from(SHAPES), feasible=st.booleans())
def test_the_relaxed_phi_never_exceeds_that_of_subproblem_2(seed: int, shape: tuple[int, int], feasible: bool) -> None:
    """With an infinite phi where there are no forces: what the relaxation cannot balance, nothing can.

    |f| <= sqrt(d) |f|_inf, so in the plane, where the cone is exact, it is at least 1 / sqrt(2) of it as well.
    """
    problem = random_problem(np.random.default_rng(seed), *shape, feasible=feasible)
    exact, relaxed = EXACT[shape].solve(problem).phi, relaxed_phi(problem)
    assert 0 < relaxed <= exact * (1 + 1e-6)
    if shape[1] == 2:
        assert relaxed >= exact / np.sqrt(2) * (1 - 1e-6)


def test_infinity_is_found_in_both_dimensions() -> None:
    """That the claim above is not empty: some random wrenches have no relaxed forces."""
    for shape in ((2, 2), (2, 3)):
        problems = [random_problem(np.random.default_rng(seed), *shape, feasible=False) for seed in range(10)]
        assert any(np.isinf(relaxed_phi(problem)) for problem in problems)


@settings(max_examples=20, deadline=None, derandomize=True)
@given(seed=SEEDS, fingers=st.integers(2, 5))
def test_three_times_the_sides_never_weaken_the_bound(seed: int, fingers: int) -> None:
    """The flats of an L-sided cone are among those of a 3L-sided one (twice the sides would put edges there)."""
    problem = random_problem(np.random.default_rng(seed), fingers, 3, feasible=True)
    bounds = [relaxed_phi(problem, sides) for sides in (4, 12, 36)]
    assert bounds[0] <= bounds[1] * (1 + 1e-7)
    assert bounds[1] <= bounds[2] * (1 + 1e-7)


def test_the_bound_rises_to_the_round_cone_where_the_box_is_tight() -> None:
    """A squeeze along x of a weight turned towards an edge: n = cos(pi / L) W / 2 mu, which rises to W / 2 mu."""
    inward = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    contacts = Contacts(points=-0.03 * inward, normals=inward, friction=np.full(2, 0.1))
    first_edge = contact_frames(inward)[0, :, 1]
    weight = ForceProblem(contacts=contacts, reference_point=np.zeros(3), wrench=np.r_[-5 * first_edge, np.zeros(3)])
    for sides in (4, 8, 16, 64):
        assert relaxed_phi(weight, sides) == pytest.approx(25 * np.cos(np.pi / sides), rel=1e-7)


def test_no_wrench_gives_no_bound() -> None:
    problem = random_problem(np.random.default_rng(0), 3, 3, feasible=True)
    still = ForceProblem(contacts=problem.contacts, reference_point=problem.reference_point, wrench=np.zeros(6))
    assert relaxed_phi(still) == 0.0


def test_highs_knows_every_option() -> None:
    """HiGHS ignores an unknown option without a word."""
    import highspy

    solver = highspy.Highs()
    for option, value in OPTIONS.items():
        assert solver.setOptionValue(option, value) == highspy.HighsStatus.kOk
        assert solver.getOptionValue(option)[1] == value


def test_solvers_print_nothing_while_they_are_made_and_solve(capfd: pytest.CaptureFixture[str]) -> None:
    relaxed_phi(random_problem(np.random.default_rng(0), 3, 3, feasible=True))
    RelaxedForces(3, 3)
    assert capfd.readouterr() == ("", "")
