"""Random small instances of problem (4) whose fingers have torsional friction, some or all of them."""

from dataclasses import replace

import numpy as np

from planner.search.finger_kind import FingerKind
from planner.search.problem import SearchProblem
from tests.strategies.force_problems import soft
from tests.strategies.limited_problems import opposite_problem
from tests.strategies.search_problems import random_problem


def soft_problem(seed: int) -> SearchProblem:
    """Two or three fingers in space: on opposite points of an ellipsoid, or anywhere; soft, mixed, or of two kinds."""
    rng = np.random.default_rng([seed, 3])
    free = opposite_problem(seed) if seed % 2 else _in_space(seed)
    free = replace(free, kinds=(), spacing=0.0, span=np.inf)
    size, count = free.length, len(free.contacts)
    torsion = np.full(count, size * 10.0 ** rng.uniform(-2, 0))
    if seed % 4 >= 2:
        torsion = np.where(rng.random(count) < 0.4, 0.0, torsion * rng.uniform(0.2, 5, count))
    kinds: tuple[FingerKind, ...] = ()
    if seed % 8 >= 6:
        first = count // 2
        kinds = (
            FingerKind(fingers=1, candidates=first, strength=float(rng.uniform(0.5, 2))),
            FingerKind(fingers=free.fingers - 1, candidates=count - first),
        )
    return replace(free, contacts=soft(free.contacts, torsion), kinds=kinds)


def _in_space(seed: int) -> SearchProblem:
    for number in range(100 * seed, 100 * seed + 100):
        problem = random_problem(number)
        if problem.contacts.dimension == 3 and problem.fingers < 4:
            return problem
    raise AssertionError("none of a hundred problems is in space with two or three fingers")
