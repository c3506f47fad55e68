"""The paper's approximation for many candidates: search a few of them, then the originals near the result.

It finds good grasps quickly and proves nothing about the candidates it left out: its status is HEURISTIC and its
bound is zero, unless a certified search of all candidates is asked for afterwards.
Source: Watanabe and Yoshikawa, end of section 4.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from planner.arrays import Indices
from planner.candidates.farthest import farthest_points
from planner.contacts import Contacts
from planner.errors import SettingError
from planner.search.certified import CertifiedSearch
from planner.search.evaluation import Evaluation
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult, Status

MOST_ROUNDS = 20
"""Stages after which the heuristic stops even if it still improves."""


@dataclass(frozen=True, kw_only=True)
class CoarseToFine:
    """Search `coarse` spread candidates, then rounds of all candidates within a radius of the best grasp's contacts."""

    coarse: int = 60
    """Candidates of the first search."""

    radius: float = 0.2
    """Radius of the neighbourhoods, relative to the largest distance of a candidate from the reference point."""

    certify: bool = False
    """Whether to finish with a certified search of all candidates, for a proven bound and gap."""

    search: CertifiedSearch = field(default_factory=CertifiedSearch)
    """Used for every stage."""

    def __post_init__(self) -> None:
        if self.coarse < 1 or not self.radius > 0:
            raise SettingError(f"{self.coarse} coarse candidates, radius {self.radius}; both must be positive")

    def run(self, problem: SearchProblem, observe: Callable[[Progress], None] = lambda _: None) -> SearchResult:
        """Search in stages until a round no longer improves the grasp.

        Args:
            problem: The full problem.
            observe: Called with every line of every stage's log.
        """
        result = self.approximate(problem, observe)
        if not self.certify:
            return result
        proof = self.search.run(problem, observe)
        better = result if result.rho < proof.rho else proof
        return replace(proof.with_grasps(better.grasps), trace=(*result.trace, *proof.trace))

    def approximate(self, problem: SearchProblem, observe: Callable[[Progress], None]) -> SearchResult:
        """The heuristic alone."""
        best: Evaluation | None = None
        trace: list[Progress] = []
        chosen = spread(problem.contacts, max(self.coarse, problem.fingers))
        for _ in range(MOST_ROUNDS):
            stage = self.search.run(problem.among(chosen), observe)
            trace += stage.trace
            found = stage.incumbent
            if best is not None and stage.rho >= best.rho * (1 - self.search.gap):
                break
            if found is not None:
                best = replace(found, subset=chosen[found.subset])
                chosen = self.near(problem, best.subset)
            elif len(chosen) < len(problem.contacts):
                chosen = spread(problem.contacts, 2 * len(chosen))  # too coarse to hold any grasp
            else:
                break
        return SearchResult(
            problem=problem,
            method="coarse to fine",
            status=Status.HEURISTIC,
            grasps=(best,) if best else (),
            lower_bound=0.0,
            cuts=np.empty((0, problem.wrenches.shape[1])),
            trace=tuple(trace),
        )

    def near(self, problem: SearchProblem, subset: Indices) -> Indices:
        """Candidates within the radius of the contacts of a grasp."""
        points = problem.contacts.points
        distances = np.linalg.norm(points[:, None] - points[subset], axis=2).min(axis=1)
        return np.flatnonzero(distances <= self.radius * problem.length)


def spread(contacts: Contacts, count: int) -> Indices:
    """Indices of `count` contacts far from each other, sorted; all if there are fewer."""
    points = np.zeros((len(contacts), 3))
    points[:, : contacts.dimension] = contacts.points
    return np.sort(farthest_points(points, min(count, len(contacts))))
