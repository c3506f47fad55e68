"""What is searched: the instances of the tables and those of the growth curves."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from planner.search.problem import SearchProblem
from scripts.search_benchmark.drill import drill_problem
from scripts.search_benchmark.prism import prism_contacts, prism_problem, thinned

USUAL_GAP = 1e-3


@dataclass(frozen=True, kw_only=True)
class Instance:
    """A problem, made when its turn comes, and how well it is to be solved."""

    name: str

    problem: Callable[[], SearchProblem]
    """Raises ObjectError where the object is not there."""

    gap: float = USUAL_GAP
    """Relative gap to prove."""

    target: float | None = None
    """Seconds within which the proof is wanted."""


def prism(fingers: int, *, division: int = 1, step: int = 1, target: float | None = None) -> Instance:
    """The prism, its cells divided, or only every `step`-th candidate kept."""
    detail = f" refined {division}x" if division > 1 else f" thinned {step}x" if step > 1 else ""
    return Instance(
        name=f"Case III{detail}, m = {fingers}",
        problem=partial(_prism_problem, fingers, division, step),
        target=target,
    )


def drill(candidates: int, fingers: int, *, gap: float = USUAL_GAP, target: float | None = None) -> Instance:
    """The scanned drill."""
    return Instance(
        name=f"drill scan, m = {fingers}" + (f", gap {gap:g}" if gap != USUAL_GAP else ""),
        problem=partial(drill_problem, candidates, fingers),
        gap=gap,
        target=target,
    )


def _prism_problem(fingers: int, division: int, step: int) -> SearchProblem:
    return prism_problem(thinned(prism_contacts(division), step), fingers)


@dataclass(frozen=True, kw_only=True)
class Benchmark:
    """Instances of the tables, and of the curves; those in both are measured once."""

    tables: tuple[Instance, ...]

    by_candidates: tuple[Instance, ...]
    """One object and one number of fingers."""

    by_fingers: tuple[Instance, ...]
    """One object and one number of candidates."""

    @property
    def instances(self) -> tuple[Instance, ...]:
        """All, none twice."""
        return tuple({each.name: each for each in self.tables + self.by_candidates + self.by_fingers}.values())


CASE3, FINE, FINEST = prism(3, target=0.15), prism(3, division=3, target=1.0), prism(3, division=6, target=4.0)

FULL = Benchmark(
    tables=(
        CASE3,
        FINE,
        FINEST,
        prism(4, division=2, target=2.0),
        drill(3000, 3, target=1.0),
        drill(1000, 4, target=6.0),
        drill(300, 5, gap=1e-2, target=30.0),
    ),
    by_candidates=(
        *(prism(3, step=step) for step in (8, 4, 2)),
        CASE3,
        prism(3, division=2),
        FINE,
        FINEST,
    ),
    by_fingers=tuple(prism(fingers, step=4) for fingers in (3, 4, 5, 6)),
)
"""The targets are set for two cores: four to eight times faster than the prototype that proved the method."""

TINY, SMALL = prism(3, step=24), prism(3, step=12, target=60.0)

QUICK = Benchmark(tables=(SMALL,), by_candidates=(TINY, SMALL), by_fingers=(TINY,))
"""Seconds in all, for a test."""
