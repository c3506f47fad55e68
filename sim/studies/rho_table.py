"""rho measured against rho predicted, over objects, numbers of fingers and what they touch with."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import nan

from planner.candidates.choice import make_candidates
from planner.grasp_problem import GraspProblem
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.search.result import Status
from planner.task import make_task
from sim.studies.survey import GAP, TIME_LIMIT, Pad
from sim.trial.loaded_grasp import LoadedGrasp
from sim.validation.critical_force import measure_critical_force


@dataclass(frozen=True, kw_only=True)
class RhoRow:
    """One planned grasp and its measurement."""

    object: str
    fingers: int
    friction: float

    patch: float
    """See `Pad` [m]."""

    predicted: float
    """rho [N]; infinite where no grasp was found."""

    lower: float
    """Largest cap with which some wrench slipped [N]."""

    upper: float
    """Least cap with which every wrench held [N]."""

    least_ratio: float
    """Least measured cap of a wrench over its prediction."""

    largest_ratio: float
    """Largest measured cap of a wrench over its prediction."""

    note: str
    """Why there is no measurement; empty if there is one."""

    @property
    def ratio(self) -> float:
        """Measured rho, the middle of its bracket, over predicted."""
        return (self.lower + self.upper) / (2 * self.predicted)


def rho_rows(
    objects: Sequence[RigidObject],
    fingers: Sequence[int],
    pads: Sequence[Pad],
    *,
    task: str = "gravity",
    candidates: str = "100",
    seed: int = 0,
) -> Iterator[RhoRow]:
    """Plan and measure every combination, in order.

    Args:
        objects: What is grasped.
        fingers: Numbers of fingers.
        pads: What they touch with.
        task: Name of a preset or a TOML file.
        candidates: How candidates are chosen; see `make_candidates`.
        seed: Of candidates and search.

    Raises:
        SimulationError: When a grasp cannot be simulated.
    """
    search = CertifiedSearch(gap=GAP, time_limit=TIME_LIMIT, seed=seed)
    for rigid_object in objects:
        for pad in pads:
            for count in fingers:
                yield _row(rigid_object, count, pad, task, candidates, search)


def _row(
    rigid_object: RigidObject, fingers: int, pad: Pad, task_name: str, choice: str, search: CertifiedSearch
) -> RhoRow:
    task = make_task(task_name, rigid_object)
    candidates = make_candidates(rigid_object, choice, pad.friction, search.seed).twisting(None, pad.patch)
    grasp = plan(GraspProblem(rigid_object, task, candidates, fingers), search)
    why = "" if grasp.found else "no grasp exists" if grasp.status is Status.INFEASIBLE else "no grasp found in time"
    row = RhoRow(
        object=rigid_object.file.stem,
        fingers=fingers,
        friction=pad.friction,
        patch=pad.patch,
        predicted=grasp.rho,
        lower=nan,
        upper=nan,
        least_ratio=nan,
        largest_ratio=nan,
        note=why,
    )
    if not grasp.found:
        return row
    critical = measure_critical_force(LoadedGrasp.of(rigid_object, grasp))
    lower, upper = critical.rho
    ratios = critical.ratios
    return replace(row, lower=lower, upper=upper, least_ratio=float(ratios.min()), largest_ratio=float(ratios.max()))
