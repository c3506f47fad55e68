"""Branch and bound on the cut table, with cuts made where they are needed.

    pop rows of tree nodes, split them, bound the children by min_k sum_j U[C_j, k];
    prune a child when its bound is at most 1 / level, with level = rho / (1 + gap) of the incumbent;
    evaluate a child that is a single subset: either a new cut prunes it, or it is the new incumbent.

When no row is open, no subset beats the level, and the cuts that pruned are the proof. With another level (see
`planner.search.incumbents`) the same search returns the k best grasps, or all within a tolerance, proven complete.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from planner.arrays import Floats, Indices
from planner.contact_models.models import free_to_turn
from planner.search.constraints.constraint import Constraints
from planner.search.constraints.distinct import Distinct
from planner.search.constraints.every_grasp import on_every_grasp
from planner.search.cuts import CutTable
from planner.search.evaluation import Evaluator
from planner.search.incumbents import SOLVER_ACCURACY, Incumbents
from planner.search.infeasible import impossible_direction
from planner.search.local_search import STARTS, add_vertex_cuts, evaluate_below, improve, random_subset
from planner.search.node_bounds import NodeBounds
from planner.search.problem import SearchProblem
from planner.search.regions.candidate_tree import build_tree
from planner.search.regions.rows import BoundedRows, Frontier, split
from planner.search.result import Progress, SearchResult, Status, relative_gap
from planner.search.settings import SearchSettings
from planner.search.two_fingers import line_bounds, pairs

FEW = 256
"""Candidates that a local search begins with: neighbours in the tree are represented by one of them."""

LOG_GROWTH = 1.02
"""Lines of the log are at least this factor of time apart, so that a long search has hundreds of them, not millions."""

LOG_PAUSE = 0.1
"""And at least this time, where nothing better was found [s]."""

BATCH = 512
"""Rows split together."""

LAST_WORK = 0.1
"""Time for tightening the bounds of a search that was stopped [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Before:
    """What earlier searches of the same problem left."""

    began: float = field(default_factory=time.perf_counter)
    """When the clock of the log and the time limit started, `time.perf_counter()` [s]."""

    subsets: Sequence[Indices] = ()
    """Subsets that are not wanted again, nor any like them, shape (m,) each."""

    cuts: Sequence[Floats] = ()
    """Cuts that are known, shape (D,) each."""


class BranchAndBound:
    """State of one certified search."""

    def __init__(
        self,
        problem: SearchProblem,
        method: SearchSettings,
        observe: Callable[[Progress], None],
        stop: Callable[[], bool],
        before: "Before | None" = None,
    ) -> None:
        """
        Args:
            problem: What to search.
            method: How.
            observe: Called with every line of the search log.
            stop: Ends the search once true.
            before: What earlier searches of the same problem left; by default there were none.
        """
        self.problem, self.method, self.observe, self.stop = problem, method, observe, stop
        before = before or Before()
        self.began = before.began
        self.evaluator = Evaluator(problem)
        self.cuts = CutTable(problem)
        self.tree = build_tree(problem)
        distinct = Distinct(problem, self.tree, before.subsets, method.apart)
        self.constraints = Constraints([*on_every_grasp(problem, self.tree), distinct])
        for direction in before.cuts:
            self.cuts.add(direction)
        self.bounds = NodeBounds(self.tree, self.cuts)
        self.frontier = Frontier(problem.fingers)
        self.frontier.push(BoundedRows.unbounded(self.tree.first_row[None]))
        self.incumbents = Incumbents(
            problem.force_ceiling,
            method.gap,
            method.keep,
            method.within,
            self.constraints.admit,  # nothing that refers to self: the tables go as soon as the search is over
        )
        self.pruned_bound = 0.0  # largest bound on 1 / rho among everything pruned or evaluated
        self.useful: set[int] = set()  # cuts that gave such a bound: they are the proof
        self.nodes = 0
        self.trace: list[Progress] = []

    @property
    def threshold(self) -> float:
        """Rows bounded by this hold nothing that is wanted [1/N]."""
        return 1 / self.incumbents.level

    def halted(self) -> Status | None:
        """Why the search has to end before its proof is complete, if it has to."""
        if self.incumbents.rho < np.inf and not (self.trace and self.trace[-1].incumbent < np.inf):
            self.log()  # the first grasp is worth keeping, and whoever can stop the search has to know
        if self.stop():
            return Status.INTERRUPTED
        return Status.TIME_LIMIT if time.perf_counter() - self.began >= self.method.time_limit else None

    def ends(self) -> bool:
        """The same as a plain question."""
        return self.halted() is not None

    def search(self) -> Status:
        add_vertex_cuts(self.cuts)
        if free_to_turn(self.problem.contacts, self.problem.fingers):
            return self.search_pairs()
        self.start_incumbent()
        if self.incumbents.best is None and not self.ends() and self.impossible_at_once():
            return Status.INFEASIBLE
        self.log_if_due()
        while len(self.frontier):
            if status := self.halted():
                return status
            self.advance()
            self.log_if_due()
        return self.proven_status()

    def search_pairs(self) -> Status:
        """Two fingers in space: the moment about their line settles most pairs, the rest are bounded and evaluated.

        Row by row of all pairs, so that the first grasps come early, and no more than a row is ever kept.
        """
        self.log()
        for subsets in pairs(self.problem):
            if status := self.halted():
                return status
            self.nodes += len(subsets)
            subsets = subsets[self.constraints.admits(subsets)]
            bounds = line_bounds(self.problem, subsets)  # whose cut every pair has of its own: none is kept
            self.remember(bounds[bounds <= self.threshold])
            self.settle(subsets[bounds > self.threshold])
            self.log_if_due()
        if status := self.halted():
            return status
        self.frontier.pop(1)
        return self.proven_status()

    def settle(self, subsets: Indices) -> None:
        """Prune what the cuts of now prune of some subsets, shape (subsets, m), and evaluate the others, best first."""
        for first in range(0, len(subsets), BATCH):
            some = subsets[first : first + BATCH]
            bounds, cuts = self.cuts.bounds(some)
            pruned = bounds <= self.threshold
            self.remember(bounds[pruned])
            self.useful.update(np.unique(cuts[pruned]).tolist())
            order = np.argsort(-bounds, kind="stable")
            for subset in some[order[~pruned[order]]]:
                if self.ends():
                    return
                self.evaluate(subset)

    def proven_status(self) -> Status:
        """What the bounds of everything pruned amount to, once nothing is open."""
        if self.incumbents.best is None:
            return Status.INFEASIBLE if self.pruned_bound <= self.threshold else self.halted() or Status.UNRESOLVED
        gap = relative_gap(self.incumbents.rho, self.lower_bound())
        if gap <= max(self.method.gap, SOLVER_ACCURACY):
            return Status.OPTIMAL
        return self.halted() or Status.UNRESOLVED  # the last subset may have been left half evaluated

    def start_incumbent(self) -> None:
        """Local search from random subsets: first among few spread candidates, then among all."""
        generator = np.random.default_rng(self.method.seed)
        few = np.sort(self.tree.spread(FEW))
        for _ in range(STARTS):
            subset = random_subset(self.problem, generator)
            if subset is None:
                return
            self.climb(self.climb(subset, few))
            self.log_if_due()

    def climb(self, subset: Indices, among: Indices | None = None) -> Indices:
        """Local search from a subset, near it or among the given candidates; returns where it ended."""
        return improve(self.evaluator, self.cuts, subset, self.incumbents, self.ends, among)

    def impossible_at_once(self) -> bool:
        """Whether one direction shows that even all candidates together cannot resist W_R; if so, it is the proof."""
        direction = impossible_direction(self.problem)
        if direction is None or not self.cuts.add(direction):
            return False
        bound = float(np.sort(self.cuts.values[:, -1])[-self.problem.fingers :].sum())
        if bound > self.threshold:
            return False
        self.frontier.pop(1)
        self.pruned_bound, self.useful = bound, {len(self.cuts) - 1}
        return True

    def advance(self) -> None:
        """Split the most recent open rows, prune, and evaluate the single subsets among their children."""
        rows = self.frontier.pop(BATCH)
        self.nodes += len(rows)
        rows = split(rows, self.tree)
        rows = rows[self.constraints.possible(rows.nodes)]
        self.bounds.extend()
        rows = self.unpruned(self.bounds.bound(rows, self.threshold))
        single = (self.tree.sizes[rows.nodes] == 1).all(axis=1)
        self.frontier.push(rows[~single])
        leaves = rows[single]
        leaves = leaves[np.argsort(-leaves.bounds, kind="stable")]
        for done, nodes in enumerate(leaves.nodes):
            if self.halted():
                self.frontier.push(leaves[done:])  # still open: the bound must not forget them
                return
            self.evaluate(np.sort(self.tree.contact[nodes]))

    def unpruned(self, rows: BoundedRows) -> BoundedRows:
        """The rows whose bounds exceed the threshold; the bounds of the others are remembered with their cuts."""
        open_ = rows.bounds > self.threshold
        self.remember(rows.bounds[~open_])
        self.useful.update(np.unique(rows.cuts[~open_]).tolist())
        return rows[open_]

    def remember(self, pruned: Floats) -> None:
        """Let the proven bound say no more than these bounds on 1 / rho do."""
        self.pruned_bound = max(self.pruned_bound, float(pruned.max(initial=0.0)))

    def evaluate(self, subset: Indices) -> None:
        """Decide a single subset: pruned by a cut, or evaluated and offered to the incumbents."""
        if self.cuts.bound(subset)[0] > self.threshold and subset not in self.incumbents:
            wanted = evaluate_below(self.evaluator, self.cuts, subset, self.incumbents.level, self.ends)
            if wanted is not None:
                self.incumbents.offer(wanted)
                self.climb(subset)
        bound, cut = self.cuts.bound(subset)
        self.useful.add(cut)
        self.pruned_bound = max(self.pruned_bound, bound)

    def lower_bound(self) -> float:
        """No subset has a smaller rho [N]; claims beyond the force ceiling, or the best rho found, are not made.

        The bound of the best grasp itself may exceed its rho by what the solver leaves open.
        """
        weakest = max(self.pruned_bound, self.frontier.weakest_bound)
        if self.incumbents.best is not None:
            weakest = max(weakest, self.cuts.bound(self.incumbents.best.subset)[0])
        most = min(self.problem.force_ceiling, self.incumbents.rho)
        return min(1 / weakest, most) if weakest > 0 else most

    def log_if_due(self) -> None:
        """Add a line to the log when there is a better grasp, and otherwise ever more rarely."""
        last = self.trace[-1] if self.trace else None
        if (
            last is None
            or self.incumbents.rho < last.incumbent
            or time.perf_counter() - self.began > LOG_GROWTH * last.seconds + LOG_PAUSE
        ):
            self.log()

    def log(self) -> None:
        line = Progress(
            seconds=time.perf_counter() - self.began,
            nodes=self.nodes,
            open=len(self.frontier),
            lower_bound=self.lower_bound(),
            incumbent=self.incumbents.rho,
            socp_solves=self.evaluator.solves,
            cuts=len(self.cuts),
        )
        self.trace.append(line)
        self.observe(line)

    def tighten(self, rows: BoundedRows) -> None:
        """Bound open rows by all cuts, the weakest first, for as long as whoever has stopped the search may wait."""
        enough = time.perf_counter() + LAST_WORK
        rows = rows[np.argsort(-rows.bounds, kind="stable")]
        for first in range(0, len(rows), BATCH):
            some = rows[first : first + BATCH]
            if time.perf_counter() < enough:
                some = self.bounds.bound(some, self.threshold)
            self.frontier.push(self.unpruned(some))

    def result(self, status: Status) -> SearchResult:
        """The end state, with the open rows bounded by all cuts."""
        if len(self.frontier):
            self.bounds.extend()
            self.tighten(self.frontier.pop(len(self.frontier)))
            self.useful.update(range(len(self.cuts)))  # any of them may bound what is still open
        self.useful.update(self.cuts.bound(grasp.subset)[1] for grasp in self.incumbents.grasps)
        self.log()
        return SearchResult(
            problem=self.problem,
            method="certified",
            status=status,
            grasps=self.incumbents.grasps,
            lower_bound=self.lower_bound(),
            cuts=self.cuts.directions[sorted(self.useful)],
            stated=self.constraints.stated(),
            trace=tuple(self.trace),
        )
