"""Random small problems with kinds of fingers, spacing or span, and their optimum by brute force."""

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import combinations
from math import dist

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.forces.minimax import MinimaxForces
from planner.forces.problem import ForceProblem
from planner.forces.reference import ReferenceForces
from planner.grasps.grasp import Certificate
from planner.search.certified import CertifiedSearch
from planner.search.finger_kind import FingerKind
from planner.search.problem import SearchProblem
from planner.verification.proof_check import certificate_of
from tests.strategies.search_problems import random_problem


def limited_problem(seed: int) -> SearchProblem:
    """`random_problem` with two kinds of fingers that overlap, or with spacing, span, or all three."""
    free = random_problem(seed)
    generator = np.random.default_rng([seed, 1])
    count, points = len(free.contacts), free.contacts.points
    usual = float(np.median([dist(a, b) for a, b in combinations(points.tolist(), 2)]))
    spacing, span = 0.7 * usual if seed % 3 else 0.0, 1.3 * usual if seed % 4 else np.inf
    if seed % 2:
        return replace(free, spacing=spacing, span=span)
    shares = np.arange(max(2, count // 2)), np.arange(count // 3, count)
    first = int(generator.integers(1, free.fingers))
    first, second = min(first, len(shares[0])), free.fingers - min(first, len(shares[0]))
    kinds = (
        FingerKind(fingers=first, candidates=len(shares[0]), strength=float(generator.uniform(0.3, 3))),
        FingerKind(fingers=second, candidates=len(shares[1])),
    )
    contacts = free.contacts.subset(np.concatenate(shares))
    return replace(free, contacts=contacts, kinds=kinds, spacing=spacing, span=span)


def opposite_problem(seed: int) -> SearchProblem:
    """Two fingers in space on opposite points of an ellipsoid, against forces at its centre: pairs that can hold it."""
    generator = np.random.default_rng([seed, 2])
    axes = generator.uniform(0.5, 2.0, 3)
    sphere = generator.normal(size=(5, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    sphere = np.concatenate([sphere, -sphere])
    normals = -sphere / axes
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    contacts = Contacts(points=sphere * axes, normals=normals, friction=generator.uniform(0.8, 1.5, 10))
    kinds = (FingerKind(fingers=1, candidates=4, strength=0.5), FingerKind(fingers=1, candidates=6))
    lengths = 2 * np.linalg.norm(contacts.points[:5], axis=1)
    return SearchProblem(
        contacts=contacts,
        fingers=2,
        reference_point=np.zeros(3),
        wrenches=np.hstack([generator.normal(size=(3, 3)), np.zeros((3, 3))]),
        kinds=() if seed % 3 else kinds,
        spacing=0.999 * float(np.sort(lengths)[3]) if seed % 3 == 1 else 0.0,
        span=1.001 * float(np.sort(lengths)[1]) if seed % 3 == 2 else np.inf,
    )


@cache
def certified(seed: int) -> tuple[Certificate, float]:
    """The certificate of a limited problem and its bound, searched once."""
    result = CertifiedSearch(gap=1e-4).run(limited_problem(seed))
    return certificate_of(result), result.lower_bound


def allowed(problem: SearchProblem, subset: tuple[int, ...]) -> bool:
    """Whether a subset has the right number of each kind, no point twice, and keeps spacing and span."""
    points = problem.contacts.points.tolist()
    ends = np.cumsum([kind.candidates for kind in problem.kinds])
    found = Counter(int((index >= ends).sum()) for index in subset)
    if any(found[number] != kind.fingers for number, kind in enumerate(problem.kinds)):
        return False
    pairs = list(combinations([points[index] for index in subset], 2))
    apart = not problem.kinds or all(a != b for a, b in pairs)
    return apart and all(problem.spacing <= dist(a, b) <= problem.span for a, b in pairs)


def unlike_all(points: Floats, earlier: list[Floats], apart: float) -> bool:
    """Whether of a grasp's contacts, shape (m, d), some is that far [m] from all contacts of each earlier grasp."""
    return all(max(min(dist(p, q) for q in before) for p in points) >= apart for before in earlier)


def least_level(problem: SearchProblem, forces: type[ReferenceForces] | type[MinimaxForces] = ReferenceForces) -> float:
    """The least rho of all allowed subsets [N], a subset left once a wrench needs more; at most the force ceiling."""
    solver = forces(problem.fingers, problem.contacts.dimension)
    strength = [kind.strength for kind in problem.kinds for _ in range(kind.candidates)]
    contacts = replace(problem.contacts, strength=np.array(strength)) if strength else problem.contacts
    least = problem.force_ceiling
    for subset in combinations(range(len(contacts)), problem.fingers):
        if allowed(problem, subset):
            grasp, rho = contacts.subset(np.array(subset)), 0.0
            for wrench in problem.wrenches:
                if rho < least:
                    case = ForceProblem(contacts=grasp, reference_point=problem.reference_point, wrench=wrench)
                    rho = max(rho, solver.solve(case).phi)
            least = min(least, rho)
    return least
