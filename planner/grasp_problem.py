"""What is planned, as data; and the one way to make it from what a user says.

GraspRequest  --pose_problem-->  GraspProblem  --planner.planning.plan-->  Grasp
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from planner.candidates.candidates import Candidates
from planner.candidates.choice import make_candidates, usual_choice
from planner.candidates.confirmed import Confirmed, confirmed_candidates
from planner.files.source_file import source_file
from planner.limits.kinds import Kinds, finger_kinds
from planner.limits.limits import Limits
from planner.limits.limits_file import read_limits
from planner.limits.restricted import Restricted, restricted
from planner.objects.graspable import Graspable
from planner.objects.mjcf.visual import visual_difference, warn_of_difference
from planner.objects.object_file import read_object_file
from planner.objects.object_source import ObjectSource
from planner.objects.rigid_object import RigidObject
from planner.search.problem import SearchProblem
from planner.task import Task, make_task


@dataclass(frozen=True, eq=False)
class GraspProblem:
    """One object, what it must withstand, where fingers may go, and what they can do."""

    rigid_object: Graspable

    task: Task
    """The wrenches it must be held against."""

    candidates: Candidates
    """Where a finger may touch it."""

    fingers: int
    """How many."""

    limits: Limits = field(default_factory=Limits)
    """What they can do; of the candidates, those that no finger may use are left out."""

    confirmed: Confirmed | None = None
    """How MuJoCo confirmed the candidates; None where it was not asked."""

    @cached_property
    def allowed(self) -> Restricted:
        """The candidates that some finger may use, and why the others are not.

        Raises:
            LimitsError: If the limits do not fit the object.
            CandidateError: If none is left.
        """
        return restricted(self.rigid_object, self.candidates, self.limits)

    @cached_property
    def kinds(self) -> Kinds:
        """The fingers, those alike together, with the candidates of each kind.

        Raises:
            LimitsError: If the limits do not fit the number of fingers, or no two candidates.
            CandidateError: If there are fewer candidates than fingers.
        """
        return finger_kinds(self.rigid_object, self.allowed.candidates, self.fingers, self.limits)

    @property
    def search_problem(self) -> SearchProblem:
        """The same in the words of the search: candidates by number.

        Raises:
            CandidateError, LimitsError, TaskError: Where the parts do not fit each other.
        """
        return SearchProblem(
            contacts=self.kinds.candidates.contacts,
            fingers=self.fingers,
            reference_point=self.task.reference_point,
            wrenches=self.task.wrenches,
            kinds=self.kinds.kinds,
            spacing=self.limits.spacing,
            span=self.limits.span,
        )


@dataclass(frozen=True, kw_only=True)
class GraspRequest:
    """What a user says, in the words of the options of `grasp-plan`."""

    source: ObjectSource
    """The object's file, and how it is read."""

    task: str = "gravity"
    """Name of a preset, or path of a TOML file."""

    candidates: str | None = None
    """See `make_candidates`; None for the usual ones of so many fingers."""

    fingers: int = 3

    friction: float | None = None
    """Coulomb coefficient of every contact; None for each geom's own."""

    friction_error: float = 0.0
    """Share by which the coefficients may be off."""

    torsion: float | None = None
    """Torsional friction of every contact [m]; None for that of the patch, or each geom's own."""

    patch: float | None = None
    """Radius of the disc that every fingertip presses flat [m]."""

    fingertip: float | None = None
    """Radius of the fingertip that must fit beside other parts' walls [m]; None for a share of the object's size."""

    limits: Path | None = None
    """TOML file of what the hand allows."""

    seed: int = 0
    """Of candidates that are evenly spread or in opposed pairs."""


def pose_problem(request: GraspRequest, show: Callable[[str], None] = lambda _: None) -> GraspProblem:
    """Read the object, make the task, choose the candidates, let MuJoCo confirm them, and read the limits.

    Args:
        request: What the user says.
        show: Told what is being done.

    Raises:
        RhograspError: Of the kind of what is wrong: object, task, candidates or limits.
    """
    show(f"reading {request.source.file}")
    rigid_object = read_object_file(request.source)
    task = make_task(request.task, rigid_object)
    choice = usual_choice(rigid_object, request.fingers) if request.candidates is None else request.candidates
    show(f"choosing candidates: {choice}")
    candidates = make_candidates(rigid_object, choice, request.friction, request.seed, request.fingertip)
    candidates = candidates.twisting(request.torsion, request.patch).least_friction(request.friction_error)
    confirmed = None
    if isinstance(rigid_object, RigidObject):
        show(f"confirming {len(candidates)} candidates with MuJoCo")
        confirmed = confirmed_candidates(rigid_object, candidates)
        candidates = confirmed.candidates
        show("comparing what is seen with what collides")
        warn_of_difference(rigid_object, visual_difference(rigid_object))
    limits = Limits()
    if request.limits is not None:
        limits = read_limits(request.limits, rigid_object)
        candidates = candidates.chosen(limits=source_file(request.limits))
    return GraspProblem(rigid_object, task, candidates, request.fingers, limits, confirmed)
