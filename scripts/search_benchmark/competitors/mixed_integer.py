"""The mixed-integer program one would write on the cut table, solved by HiGHS with cuts added as they are needed.

    max t   s.t.   t <= sum_i a_i(lambda_k) x_i  for every cut k,   sum_i x_i = m,   x binary

Solve it, evaluate the subset it likes best, add the cuts of every wrench that asks for more than 1 / t, repeat. Its
bound on t is a bound on 1 / rho* at any time. t is divided by its first bound, so that HiGHS sees numbers near one.
"""

import time

import highspy
import numpy as np

from planner.arrays import Floats, Indices
from planner.forces.quiet_highs import QuietHighs
from planner.search.cuts import CutTable
from planner.search.evaluation import Evaluator
from planner.search.local_search import add_vertex_cuts
from planner.search.problem import SearchProblem
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.isolated import run_isolated

MASTER_GAP = 0.1
"""Relative gap of the master, as a part of the gap wanted."""

VIOLATED = 1e-9
"""Relative violation from which a cut is added."""

GRACE = 30.0
"""Seconds that HiGHS may overrun its time limit before it is stopped and its bound is lost."""


def solve_with_cuts(problem: SearchProblem, gap: float, budget: float) -> Outcome:
    """Alternate master and evaluation until the gap is proven or the budget [s] is spent."""
    answer = run_isolated(_solve, problem, gap, budget, limit=budget + GRACE)
    return answer.value if answer else Outcome(seconds=budget, finished=False, note="stopped")


def _solve(problem: SearchProblem, gap: float, budget: float) -> Outcome:
    return _Model(problem, gap, budget).solve()


class _Model:
    """The master, the cuts and the best subset so far."""

    def __init__(self, problem: SearchProblem, gap: float, budget: float) -> None:
        self.began = time.perf_counter()
        self.problem, self.gap, self.budget = problem, gap, budget
        self.evaluator, self.cuts = Evaluator(problem), CutTable(problem)
        add_vertex_cuts(self.cuts)
        self.unit = float(np.sort(self.cuts.values, axis=0)[-problem.fingers :].sum(axis=0).min())
        self.master = self._master()
        self.upper, self.rho = 1.0, np.inf
        for values in self.cuts.values.T:
            self._add_row(values)

    @property
    def seconds(self) -> float:
        return time.perf_counter() - self.began

    @property
    def lower_bound(self) -> float:
        """Proven of rho* [N]."""
        return 1 / (self.unit * self.upper)

    @property
    def proven(self) -> bool:
        return self.rho <= self.lower_bound * (1 + self.gap)

    def solve(self) -> Outcome:
        while not self.proven and self.seconds < self.budget:
            self.master.setOptionValue("time_limit", self.master.getRunTime() + self.budget - self.seconds)
            self.master.run()
            self.upper = min(self.upper, self.master.getInfo().mip_dual_bound)
            if self.master.getInfo().primal_solution_status != highspy.SolutionStatus.kSolutionStatusFeasible:
                break
            chosen = np.array(self.master.getSolution().col_value[: len(self.problem.contacts)])
            self._evaluate(np.sort(np.argsort(chosen)[-self.problem.fingers :]))
        note = "" if self.proven else "stopped"
        return Outcome(
            seconds=self.seconds, finished=self.proven, rho=self.rho, lower_bound=self.lower_bound, note=note
        )

    def _evaluate(self, subset: Indices) -> None:
        """All wrenches; each that the table had not foreseen becomes a row."""
        foreseen = self.cuts.bound(subset)[0]
        solutions = [self.evaluator.solve(subset, vertex) for vertex in range(len(self.problem.wrenches))]
        self.rho = min(self.rho, max(phi for _, phi, _ in solutions))
        for _, _, direction in solutions:
            if self.cuts.add_if_below(direction, subset, foreseen * (1 - VIOLATED)):
                self._add_row(self.cuts.values[:, -1])

    def _add_row(self, values: Floats) -> None:
        """t - sum_i a_i x_i <= 0."""
        coefficients = np.append(-values / self.unit, 1.0)
        self.master.addRow(-highspy.kHighsInf, 0.0, len(coefficients), np.arange(len(coefficients)), coefficients)

    def _master(self) -> QuietHighs:
        """x and t, and the number of fingers."""
        count = len(self.problem.contacts)
        master = QuietHighs()
        master.setOptionValue("mip_rel_gap", MASTER_GAP * self.gap)
        master.addVars(count + 1, np.zeros(count + 1), np.ones(count + 1))
        for candidate in range(count):
            master.changeColIntegrality(candidate, highspy.HighsVarType.kInteger)
        master.changeColCost(count, 1.0)
        master.changeObjectiveSense(highspy.ObjSense.kMaximize)
        fingers = float(self.problem.fingers)
        master.addRow(fingers, fingers, count, np.arange(count), np.ones(count))
        return master
