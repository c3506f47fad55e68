"""Random small objects with candidates on their faces, and everything a search may be asked about them.

Boxes with grids (symmetric: many ties), hulls of random points, and polygons in the plane; friction that is the same
everywhere or not, known or with an error; one to four fingers, alike or of two or three kinds and strengths, with
spacing and span; tasks that can be held and tasks that cannot.
"""

from dataclasses import replace

import numpy as np
from scipy.spatial import ConvexHull

from planner.arrays import Floats
from planner.contacts import Contacts, wrench_dimension
from planner.search.certified import CertifiedSearch
from planner.search.finger_kind import FingerKind
from planner.search.problem import SearchProblem

MOST_CANDIDATES = {1: 60, 2: 60, 3: 44, 4: 26}
"""By the number of fingers."""

OFTEN_OPEN = {1: 60, 2: 60, 3: 90, 4: 44}
"""For every third seed: searches with rows that stay open while better grasps are found."""


def small_problem(seed: int) -> SearchProblem:
    """What is searched."""
    generator = np.random.default_rng([seed, 11])
    fingers = int(generator.choice([1, 2, 3, 3, 3, 4, 4]))
    points, normals = (_box, _hull, _polygon)[int(generator.integers(3))](generator)
    most = (MOST_CANDIDATES if seed % 3 else OFTEN_OPEN)[fingers]
    chosen = np.sort(generator.permutation(len(points))[:most])
    contacts = Contacts(
        points=points[chosen],
        normals=normals[chosen],
        friction=_friction(generator, len(chosen)),
    )
    length = float(np.abs(contacts.points).max())
    problem = SearchProblem(
        contacts=contacts,
        fingers=fingers,
        reference_point=np.zeros(points.shape[1]),
        wrenches=_task(generator, points.shape[1], fingers, length),
    )
    return _limited(problem, generator, length)


def settings(seed: int) -> CertifiedSearch:
    """What is asked: a gap, and sometimes several grasps."""
    generator = np.random.default_rng([seed, 12])
    several = seed % 3 == 0
    return CertifiedSearch(
        gap=float(10.0 ** -generator.integers(2, 7)),
        keep=int(generator.integers(2, 5)) if several else 1,
        within=float(generator.choice([0.01, 0.1])) if several and seed % 2 else None,
        apart=0.02 if several and seed % 5 == 0 else 0.0,
        seed=seed,
    )


def _box(generator: np.random.Generator) -> tuple[Floats, Floats]:
    """A grid on every face of a cuboid, often a cube."""
    half = generator.choice([0.02, 0.03, 0.05], 3)
    steps = np.linspace(-0.75, 0.75, 4)
    points, normals = [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            for u in steps:
                for v in steps:
                    points.append(np.insert([u, v], axis, side) * half)
                    normals.append(-side * np.eye(3)[axis])
    return np.array(points), np.array(normals)


def _hull(generator: np.random.Generator) -> tuple[Floats, Floats]:
    """Four points on every facet of the hull of random points."""
    cloud = 0.04 * generator.normal(size=(int(generator.integers(5, 14)), 3))
    hull = ConvexHull(cloud - cloud.mean(axis=0))
    weights = np.array([[1, 1, 1], [4, 1, 1], [1, 4, 1], [1, 1, 4]]) / np.array([[3], [6], [6], [6]])
    points = np.einsum("wv,fvd->fwd", weights, hull.points[hull.simplices]).reshape(-1, 3)
    return points, -np.repeat(hull.equations[:, :3], len(weights), axis=0)


def _polygon(generator: np.random.Generator) -> tuple[Floats, Floats]:
    """Six points on every edge of a convex polygon."""
    cloud = 0.04 * generator.normal(size=(int(generator.integers(4, 10)), 2))
    hull = ConvexHull(cloud - cloud.mean(axis=0))
    ends = hull.points[hull.simplices]
    shares = np.linspace(0.1, 0.9, 6)[:, None]
    points = (ends[:, :1] * shares + ends[:, 1:] * (1 - shares)).reshape(-1, 2)
    return points, -np.repeat(hull.equations[:, :2], len(shares), axis=0)


def _friction(generator: np.random.Generator, contacts: int) -> Floats:
    """One coefficient, two, or as many as contacts; the least that an error in it leaves."""
    levels = (1, 2, contacts)[int(generator.integers(3))]
    friction = generator.uniform(0.2, 1.2, levels)[np.arange(contacts) * levels // contacts]
    return np.asarray(friction * (1 - generator.choice([0.0, 0.2])))


def _task(generator: np.random.Generator, dimension: int, fingers: int, length: float) -> Floats:
    """Pushes along all axes with moments or without, or a single load; a pull on one finger cannot be held."""
    size = wrench_dimension(dimension)
    scale = np.r_[np.ones(dimension), np.full(size - dimension, length)]
    kind = int(generator.integers(4))
    if kind == 0:
        return np.concatenate([np.eye(size), -np.eye(size)]) * 0.3 * scale
    if kind == 1:
        pushes = np.concatenate([np.eye(dimension), -np.eye(dimension)])
        return np.hstack([pushes, 0.02 * length * generator.normal(size=(len(pushes), size - dimension))])
    if kind == 2 or fingers < 3:
        return np.insert(np.zeros((1, size - 1)), dimension - 1, 1.0, axis=1)
    return generator.normal(size=(int(generator.integers(1, 6)), size)) * 0.3 * scale


def _limited(problem: SearchProblem, generator: np.random.Generator, length: float) -> SearchProblem:
    """The problem with least and greatest distances, or with kinds of fingers, or as it is."""
    spacing, span = generator.choice([0.0, 0.2 * length]), generator.choice([np.inf, 1.8 * length])
    problem = replace(problem, spacing=float(spacing), span=float(span))
    if problem.fingers == 1 or generator.random() < 0.6:
        return problem
    return _with_kinds(problem, generator)


def _with_kinds(problem: SearchProblem, generator: np.random.Generator) -> SearchProblem:
    """Two kinds of fingers, or every finger another, each with some of the candidates and a strength of its own."""
    count, fingers = len(problem.contacts), problem.fingers
    strong = int(generator.integers(1, fingers))
    numbers = [strong, fingers - strong] if generator.random() < 0.7 else [1] * fingers
    shares = [np.sort(generator.permutation(count)[: max(fingers, count // len(numbers) + 3)]) for _ in numbers]
    kinds = tuple(
        FingerKind(fingers=number, candidates=len(share), strength=float(generator.choice([0.5, 1.0, 2.0, 3.7])))
        for number, share in zip(numbers, shares, strict=True)
    )
    return replace(problem, contacts=problem.contacts.subset(np.concatenate(shares)), kinds=kinds)
