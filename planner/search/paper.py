"""The paper's branch and bound, step by step.

Symbols, as printed:
    N           a combination of m of the n candidate contacts
    LIST        the combinations that may still be the best
    rho_hat     temporary optimal solution: the least exact rho so far
    rho_hat_N   temporary bound of N: the largest phi that a lower-bounding problem gave for it
    w_hat       the vertex of W_R at which the last exactly solved combination needed most force

Step 4 solves one small problem for every N in LIST at the single vertex w_hat: the Relaxed Problem (9), or
Subproblem 2 in its place. Only the few N that then look best are solved exactly, at all vertices. LIST is kept in
arrays and worked through in chunks on all cores: a few bytes per combination, whatever their number.

Source: Watanabe and Yoshikawa, section 3.2.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import chain, combinations
from math import comb

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.errors import CandidateError
from planner.forces.relaxation import SIDES
from planner.search.evaluation import Evaluation, Evaluator
from planner.search.lower_bounds import Bound, LowerBounds
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult, Status

MOST_SUBSETS = 50_000_000
"""Longest LIST: about a gigabyte."""


@dataclass(frozen=True, kw_only=True)
class PaperSearch:
    """Steps 1 to 7. Exact up to epsilon; bounded by the number of combinations."""

    epsilon: float = 1e-3
    """Stop when every N left is bounded within this, relative to rho_hat."""

    bound: Bound = "relaxation"
    """What bounds N in step 4: the Relaxed Problem (9), or Subproblem 2 in its place."""

    sides: int = SIDES
    """L, edges of the polyhedral cone of the Relaxed Problem."""

    seed: int = 0
    """Seed of the order in which step 2 tries combinations."""

    def run(self, problem: SearchProblem, observe: Callable[[Progress], None] = lambda _: None) -> SearchResult:
        """Search all combinations.

        Raises:
            CandidateError: When there are more combinations than LIST may hold, or limits the paper does not know.
        """
        if not problem.is_the_papers:
            raise CandidateError(
                "the paper's search knows neither kinds of fingers nor torsional friction nor distances between "
                "contacts nor position errors; use the certified search"
            )
        if problem.subsets > MOST_SUBSETS:
            raise CandidateError(
                f"{problem.subsets:,} combinations; the paper's search keeps a list of them and takes at most "
                f"{MOST_SUBSETS:,}; use the certified search"
            )
        return _Run(problem, self, observe).search()


class _Run:
    """LIST, rho_hat and w_hat of one search."""

    def __init__(self, problem: SearchProblem, method: PaperSearch, observe: Callable[[Progress], None]) -> None:
        self.problem, self.method, self.observe = problem, method, observe
        self.began = time.perf_counter()
        self.evaluator = Evaluator(problem)
        self.lower_bounds = LowerBounds(problem, method.bound, method.sides)
        self.list = all_subsets(len(problem.contacts), problem.fingers)
        self.bound = np.zeros(len(self.list))  # rho_hat_N
        self.best: Evaluation | None = None
        self.vertex = 0  # w_hat
        self.solved = 0  # combinations solved exactly, at all vertices
        self.trace: list[Progress] = []

    @property
    def rho(self) -> float:
        """rho_hat [N]."""
        return self.best.rho if self.best else np.inf

    def search(self) -> SearchResult:
        self.first_incumbent()
        while self.best is not None and not self.finished():
            relaxed = self.bound_all()
            self.solve_most_promising(relaxed)
        return self.result()

    def first_incumbent(self) -> None:
        """Steps 2 and 3: solve combinations in random order until one is feasible."""
        for index in np.random.default_rng(self.method.seed).permutation(len(self.list)):
            if self.solve(index):
                return
        self.keep(np.zeros(len(self.list), dtype=bool))

    def bound_all(self) -> Floats:
        """Step 4: bound every N in LIST at w_hat, eliminate what is infeasible or worse than rho_hat."""
        relaxed = self.lower_bounds.solve(self.list, self.vertex)
        np.maximum(self.bound, relaxed, out=self.bound)
        alive = self.bound <= self.rho  # infeasible: infinite
        self.keep(alive)
        self.log()
        return relaxed[alive]

    def solve_most_promising(self, relaxed: Floats) -> None:
        """Steps 5 and 6: solve exactly the N of least relaxed phi, the next one as long as they do not improve."""
        alive = np.ones(len(self.list), dtype=bool)
        for index in np.argsort(relaxed, kind="stable"):
            if self.close_enough(self.bound[index]):
                continue
            alive[index] = False  # solved exactly: either the new best, or eliminated
            before = self.rho
            if self.solve(index) and self.rho < before:
                break
        self.keep(alive)

    def finished(self) -> bool:
        """Step 7: rho_hat - rho_hat_N < epsilon for all N in LIST."""
        return bool(self.close_enough(self.bound).all())

    def close_enough(self, bound: Floats | float) -> Mask:
        return np.asarray(bound) > self.rho * (1 - self.method.epsilon)

    def solve(self, index: int) -> bool:
        """Subproblem 1 for one N: updates rho_hat and w_hat; returns whether N is feasible."""
        evaluation = self.evaluate(self.list[index])
        if evaluation is None:
            self.bound[index] = np.inf
            return False
        self.solved += 1
        self.bound[index] = evaluation.rho
        self.vertex = evaluation.critical_wrench
        if evaluation.rho < self.rho:
            self.best = evaluation
        return True

    def evaluate(self, subset: Indices) -> Evaluation | None:
        """All vertices of one N, w_hat first; None as soon as one is infeasible."""
        vertices = np.roll(np.arange(len(self.problem.wrenches)), -self.vertex)
        solutions = {}
        for vertex in vertices.tolist():
            solutions[vertex] = self.evaluator.solve(subset, vertex)
            if not solutions[vertex][1] < self.problem.force_ceiling:
                return None
        return self.evaluator.collect(subset, [solutions[vertex] for vertex in sorted(solutions)])

    def keep(self, alive: Mask) -> None:
        """Eliminate from LIST."""
        self.list, self.bound = self.list[alive], self.bound[alive]

    def log(self) -> None:
        lowest = min(float(self.bound.min(initial=np.inf)), self.rho)
        line = Progress(
            seconds=time.perf_counter() - self.began,
            nodes=self.solved,
            open=len(self.list),
            lower_bound=min(lowest, self.problem.force_ceiling),
            incumbent=self.rho,
            socp_solves=self.evaluator.solves,
            cuts=0,
        )
        self.trace.append(line)
        self.observe(line)

    def result(self) -> SearchResult:
        self.log()
        return SearchResult(
            problem=self.problem,
            method=f"paper, bounded by the {self.method.bound}",
            status=Status.OPTIMAL if self.best else Status.INFEASIBLE,
            grasps=(self.best,) if self.best else (),
            lower_bound=self.trace[-1].lower_bound,
            cuts=np.empty((0, self.problem.wrenches.shape[1])),
            trace=tuple(self.trace),
        )


def all_subsets(count: int, size: int) -> Indices:
    """All combinations of `size` of `count` numbers, shape (C(count, size), size), streamed into one array."""
    members = chain.from_iterable(combinations(range(count), size))
    return np.fromiter(members, dtype=np.int32, count=size * comb(count, size)).reshape(-1, size)
