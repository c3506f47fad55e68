"""Many grasps, measured: is the instrument ever wrong?

Random grasps, not optimised ones, because a search prefers grasps that are well conditioned. Every wrench of every
grasp is a test of its own, with the cap at given multiples of its own predicted phi: above one it must be held,
below one it must slip.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Floats, Mask
from planner.candidates.choice import make_candidates
from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.grasp_problem import GraspProblem
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.progress import Done
from planner.search.certified import CertifiedSearch
from planner.task import Task, make_task
from sim.trial.experiment import set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.prediction import predicted_caps
from sim.trial.protocol import ValidationProtocol

CANDIDATES = "60"
"""Random grasps choose among so many evenly spread contacts."""
GAP, TIME_LIMIT = 0.05, 10.0
"""The planner's gap and its seconds per grasp [s]: a good grasp is wanted, not a proof."""
FINGERS = (3, 4, 5)
SOFT_FINGERS = (2, 3)
"""Of grasps some of whose fingers are soft."""
TORSION = (0.002, 0.12)
"""Range of a random torsional friction over the object's size, drawn on a logarithmic scale."""
HARD = 0.4
"""How often a finger is hard, in every second of these grasps."""
FRICTION = (0.3, 1.0)
"""Range of the friction coefficient of a random grasp."""
MOST_DRAWS = 2_000
"""Bound on the draws for one feasible grasp; a few dozen are usual."""


@dataclass(frozen=True, kw_only=True)
class Pad:
    """What all fingers of a grasp touch with."""

    friction: float
    """Coulomb coefficient."""

    patch: float = 0.0
    """Radius of the disc that it presses flat [m]; 0 for a point."""


@dataclass(frozen=True, kw_only=True)
class Tally:
    """Outcomes of all single-wrench tests at one multiple of phi."""

    factor: float
    tests: int
    """Those of wrenches off the friction limit."""

    wrong: int
    """Of these, slips above phi (false fails) or holds below it (false passes)."""

    worst_slip: float
    """Of these, over R0: the largest slip above phi, the smallest below it; between them lies the threshold."""

    worst_spin: float
    """Of these, the same of soft fingers [rad]; below phi it is small where they slip and do not spin."""

    limited: int
    """Tests of wrenches on the friction limit, which validations name: small loads beside the cap, so that what is left
    unbalanced below phi moves the object too slowly to be seen."""

    limited_wrong: int
    """Of these, slips above phi or holds below it."""


def random_grasps(
    objects: Sequence[RigidObject], count: int, seed: int, task: str = "gravity", *, soft: bool = False
) -> list[LoadedGrasp]:
    """Random feasible grasps that pass the static check, objects and numbers of fingers in turn.

    Args:
        objects: What is grasped.
        count: How many grasps.
        seed: Of all that is random.
        task: Name of a preset or a TOML file.
        soft: With torsional friction, of all fingers or of some.

    Raises:
        SimulationError: When an object has no feasible grasp among MOST_DRAWS.
    """
    rng = np.random.default_rng(seed)
    tasks = [make_task(task, each) for each in objects]
    candidates = [make_candidates(each, CANDIDATES, 0.5, seed).contacts for each in objects]
    numbers, grasps = SOFT_FINGERS if soft else FINGERS, []
    for index in range(count):
        turn, which = divmod(index, len(objects))
        touching = candidates[which]
        if soft:
            touching = _softened(touching, objects[which].size, rng, mixed=turn // len(numbers) % 2 == 1)
        grasps.append(_drawn(objects[which], tasks[which], touching, numbers[turn % len(numbers)], rng))
    return grasps


def _softened(candidates: Contacts, size: float, rng: np.random.Generator, *, mixed: bool) -> Contacts:
    """Each candidate with a torsional friction of its own; some of the mixed ones without."""
    least, most = np.log(TORSION)
    torsion = size * np.exp(rng.uniform(least, most, len(candidates)))
    return replace(candidates, torsion=np.where(rng.random(len(candidates)) < (HARD if mixed else 0.0), 0.0, torsion))


def planned_grasp(rigid_object: RigidObject, fingers: int, pad: Pad, seed: int) -> LoadedGrasp:
    """A grasp as the planner chooses it, against gravity.

    Args:
        rigid_object: What is grasped.
        fingers: Number of fingers.
        pad: What they touch with.
        seed: Of candidates and search.

    Raises:
        SimulationError: When the planner finds none.
    """
    task = make_task("gravity", rigid_object)
    search = CertifiedSearch(gap=GAP, time_limit=TIME_LIMIT, seed=seed)
    candidates = make_candidates(rigid_object, CANDIDATES, pad.friction, seed).twisting(None, pad.patch)
    grasp = plan(GraspProblem(rigid_object, task, candidates, fingers), search)
    if not grasp.found:
        raise SimulationError(
            f"no grasp of {rigid_object.file.name} with {fingers} fingers and friction {pad.friction:g} was found "
            f"({grasp.status}); allow more fingers or friction"
        )
    return LoadedGrasp.of(rigid_object, grasp)


def _drawn(
    rigid_object: RigidObject, task: Task, candidates: Contacts, fingers: int, rng: np.random.Generator
) -> LoadedGrasp:
    friction = np.full(len(candidates), rng.uniform(*FRICTION))
    for _ in range(MOST_DRAWS):
        chosen = rng.choice(len(candidates), size=fingers, replace=False)
        contacts = replace(candidates, friction=friction).subset(chosen)
        if candidates.torsions.any() and not contacts.torsions.any():
            continue
        if not np.isfinite(predicted_caps(contacts, task.reference_point, task.wrenches[:1])[0]):
            continue
        phi = predicted_caps(contacts, task.reference_point, task.wrenches)
        grasp = LoadedGrasp(
            rigid_object=rigid_object,
            contacts=contacts,
            reference_point=task.reference_point,
            wrenches=task.wrenches,
            phi=phi,
        )
        if np.isfinite(phi).all() and not set_up(grasp).static.reasons():
            return grasp
    raise SimulationError(
        f"no feasible grasp of {rigid_object.file.name} with {fingers} fingers among {MOST_DRAWS} random ones"
    )


def tally(
    grasps: Sequence[LoadedGrasp],
    factors: Sequence[float],
    protocol: ValidationProtocol | None = None,
    observe: Done = lambda _: None,
) -> list[Tally]:
    """Count wrong outcomes of single-wrench tests, one entry per factor.

    Args:
        grasps: What to test; every wrench of each.
        factors: Caps relative to the wrench's own phi.
        protocol: Settings and thresholds; by default those for such contacts, `active_protocol`.
        observe: Called with the number of grasps done after each.

    Raises:
        SimulationError: When an experiment cannot be run.
    """
    outcomes = []
    for done, outcome in enumerate(_outcomes(grasps, factors, protocol), start=1):
        outcomes.append(outcome)
        observe(done)
    held, slips, spins, limited = (np.hstack(each) for each in zip(*outcomes, strict=True))
    wrong = held != (np.array(factors) > 1)[:, None]
    return [
        Tally(
            factor=factor,
            tests=int((~limited).sum()),
            wrong=int(wrong[row, ~limited].sum()),
            worst_slip=_worst(slips[row, ~limited], above=factor > 1),
            worst_spin=_worst(spins[row, ~limited], above=factor > 1),
            limited=int(limited.sum()),
            limited_wrong=int(wrong[row, limited].sum()),
        )
        for row, factor in enumerate(factors)
    ]


def _worst(slips: Floats, *, above: bool) -> float:
    """The slip, or the spin, nearest to the threshold."""
    return float(slips.max(initial=0.0) if above else slips.min(initial=np.inf))


def _outcomes(
    grasps: Sequence[LoadedGrasp], factors: Sequence[float], protocol: ValidationProtocol | None
) -> Iterator[tuple[Mask, Floats, Floats, Mask]]:
    """Of each grasp held, slip and spin of every wrench, each of shape (factors, wrenches), and which are limited."""
    for grasp in grasps:
        scaled = grasp.wrenches * (grasp.rho / grasp.phi)[:, None]
        shape = (len(factors), len(scaled))
        experiment = set_up(grasp, protocol)
        outcome = experiment.measure(np.tile(scaled, (len(factors), 1)), np.repeat(factors, shape[1]))
        limited = grasp.friction_limited(experiment.protocol.friction_margin)
        yield outcome.held.reshape(shape), outcome.slip.reshape(shape), outcome.spin.reshape(shape), limited
