"""What `grasp-plan` says while it works and when it is done."""

import logging
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from planner.arrays import Floats
from planner.candidates.candidates import Candidates
from planner.candidates.confirmed import Confirmed
from planner.counted import counted
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp
from planner.limits.kinds import Kinds
from planner.limits.restricted import Restricted, removals
from planner.millimetres import LEAST, in_mm, point_in_mm
from planner.objects.given_mass import GivenMass
from planner.objects.graspable import Graspable
from planner.objects.plausibility import candidate_doubts, torsion_doubts
from planner.objects.rigid_object import RigidObject
from planner.search.result import Status
from planner.task import Task
from planner.terminal.console import Console
from planner.verification.why_infeasible import reasons, remedies

logger = logging.getLogger(__name__)

SEEN_TURN = np.deg2rad(0.1)
"""Least turn of the body in its file that is worth a word [rad]."""


class Report:
    """Says it in lines that stay."""

    def __init__(self, console: Console) -> None:
        self._console = console

    def problem(self, problem: GraspProblem) -> None:
        """What is about to be searched."""
        rigid_object, task, fingers = problem.rigid_object, problem.task, problem.fingers
        candidates = problem.candidates if problem.confirmed is None else problem.confirmed.asked
        extent = " x ".join(in_mm(edge) for edge in rigid_object.extent)
        self._say(
            f"object      {rigid_object.file}, body {rigid_object.body!r}: {rigid_object.mass:.4g} kg, {extent} mm"
        )
        self._as_read(rigid_object)
        self._say(f"task        {task.name}: {_wrenches(rigid_object, task)}")
        self._say(f"candidates  {len(candidates)}, friction {_friction(rigid_object, candidates)}; {fingers} fingers")
        if candidates.moved > LEAST:
            self._say(f"moved       onto the surface by at most {in_mm(candidates.moved, 2)} mm")
        if problem.confirmed is not None:
            self._dropped(problem.confirmed)
        self._restricted(problem.allowed)
        if problem.kinds.candidates.contacts.torsions.any():
            self._say(f"torsion     {_torsion(problem)}")
        elif candidates.planned_torsion:
            logger.warning(
                "the grasp whose contacts are the candidates was planned with a torsional friction of %s mm; only "
                "their places are taken, and fingers are hard: --torsion %.6g plans with it",
                in_mm(candidates.planned_torsion, 3),
                candidates.planned_torsion,
            )
        self._kinds(problem.kinds)
        self._choice(problem)

    def _as_read(self, rigid_object: Graspable) -> None:
        """Mass properties that are given, joints that are frozen, and parts that are only obstacles."""
        source, touchable = rigid_object.source, rigid_object.touchable
        if not source.given.nothing:
            self._say(f"given       {_given(source.given)}, in place of the file's")
        if source.locked_joints:
            where = "qpos0" if source.keyframe is None else f"keyframe '{source.keyframe}'"
            self._say(f"locked      {', '.join(source.locked_joints)}: one rigid object, its joints as at {where}")
        if not touchable.all():
            self._say(
                f"touched     {touchable.sum()} of {len(touchable)} geoms, those of body "
                f"'{rigid_object.body}'; the others are of the object, and obstacles"
            )

    def decomposed(self, file: Path, parts: int) -> None:
        """What is planned on in place of the object's file."""
        self._say(f"decomposed  {file}: {parts} convex parts")

    def _dropped(self, confirmed: Confirmed) -> None:
        """Candidates that MuJoCo does not confirm, if there are any."""
        if confirmed.dropped:
            self._say(
                f"dropped     {confirmed.dropped} candidates that MuJoCo does not confirm: {confirmed.off_surface} off "
                f"its surface, {confirmed.turned} with another normal, {confirmed.crowded} touching another part; "
                f"{len(confirmed.candidates)} are left"
            )

    def _restricted(self, allowed: Restricted) -> None:
        """Candidates that the limits of the fingers forbid, if there are any."""
        if any(allowed.removed.values()):
            self._say(
                f"limits      {sum(allowed.removed.values())} candidates are not for fingers: "
                f"{removals(allowed.removed)}; {len(allowed.candidates)} are left"
            )

    def _choice(self, problem: GraspProblem) -> None:
        """Whether there is much to choose from, and whether fingers can twist like that."""
        few = candidate_doubts(len(problem.allowed.candidates), problem.fingers)
        for doubt in [*few, *torsion_doubts(problem.rigid_object, problem.kinds.candidates.contacts)]:
            logger.warning("%s", doubt)

    def _kinds(self, kinds: Kinds) -> None:
        """Fingers that differ, if they do."""
        torsions = np.split(kinds.candidates.contacts.torsions, np.cumsum([share.candidates for share in kinds.kinds]))
        for kind, share in enumerate(kinds.kinds):
            names = ", ".join(str(1 + finger) for finger in np.flatnonzero(kinds.of_finger == kind))
            twist = f", torsion {_spread_in_mm(torsions[kind])}" if torsions[kind].any() else ""
            self._say(
                f"{'' if kind else 'fingers':11s} {names}: strength {share.strength:g}{twist}, "
                f"{share.candidates} candidates"
            )

    def grasp(self, grasp: Grasp, out: Path, with_pads: Grasp | None = None) -> None:
        """The outcome, what pads would do where two hard fingers fail, and where it was written."""
        self._say()
        if grasp.status is Status.INFEASIBLE:
            self._infeasible(grasp, with_pads)
        elif not grasp.found:
            more = "" if grasp.status is Status.UNRESOLVED else "; allow more time"
            self._say(f"no grasp found yet{more} ({grasp.status})")
        else:
            self._contacts(grasp)
        self._say(f"wrote       {out}")

    def others(self, grasps: Sequence[Grasp], files: Sequence[Path], apart: float) -> None:
        """The grasps after the best, and what is proven of them."""
        for number, (grasp, file) in enumerate(zip(grasps, files, strict=True), start=2):
            self._say(f"grasp {number:<5d} rho {grasp.rho:.6g} N ({grasp.gap:.3%} above the bound), {file}")
        if grasps:
            self._say(f"their proof {_proof_of_others(grasps[0], apart)}")

    def _contacts(self, grasp: Grasp) -> None:
        strengths = grasp.contacts.strengths
        hard = "this hard" if (strengths == 1).all() else "its strength times this hard"
        self._say(f"rho         {grasp.rho:.6g} N: every finger must be able to push {hard} ({grasp.status})")
        subsets = counted(grasp.search.subsets, "subset")
        self._say(
            f"proof       no {grasp.search.fingers} of the {grasp.search.candidates} candidates ({subsets}) "
            f"need less than {grasp.lower_bound:.6g} N (gap {grasp.gap:.3%})"
        )
        self._checked(grasp)
        grip = grasp.grip
        self._say(f"grip        {grip:.6g} N: the largest normal force of a finger (what gripper catalogues state)")
        torsions = grasp.contacts.torsions
        differ = np.ptp(torsions) > 0
        contacts = zip(grasp.contacts.points, grasp.geoms, strengths, torsions, strict=True)
        for number, (point, geom, strength, torsion) in enumerate(contacts, start=1):
            position = " ".join(f"{1000 * coordinate:9.3f}" for coordinate in point)
            stronger = "" if strength == 1 else f", strength {strength:g}"
            softer = f", torsion {in_mm(torsion, 3)} mm" if differ else ""
            self._say(f"contact {number}   {position} mm on {geom}{stronger}{softer}")

    def _infeasible(self, grasp: Grasp, with_pads: Grasp | None) -> None:
        self._say(
            f"infeasible  proven: no {grasp.search.fingers} of the {grasp.search.candidates} candidates resist "
            f"the task with less than {grasp.lower_bound:.3g} N per finger"
        )
        self._checked(grasp)
        for reason in reasons(grasp):
            self._say(f"because     {reason}")
        for remedy in remedies(grasp, with_pads):
            self._say(f"may help    {remedy}")

    def _checked(self, grasp: Grasp) -> None:
        """How much of the proof was checked at once."""
        check = grasp.proof_check
        if check is None:
            return
        if check.share == 0:
            self._say("checked     nothing yet of this proof; grasp-verify checks it")
        elif check.share < 1:
            self._say(
                f"checked     {_percent(check.share)} of the subsets, by the code of grasp-verify, in "
                f"{check.seconds:.2g} s; the rest is not checked yet, grasp-verify checks all"
            )
        else:
            self._say(f"checked     all subsets, by the code of grasp-verify, in {check.seconds:.2g} s")

    def _say(self, text: str = "") -> None:
        self._console.say(text)


def _percent(share: float) -> str:
    """A share below one, never rounded up to all of it."""
    return f"{min(100 * share, 99.9):.3g} %"


def _proof_of_others(grasp: Grasp, apart: float) -> str:
    """What is known of the grasps after the best, by whom."""
    bound = f"the files prove that no choice at all needs less than {grasp.lower_bound:.6g} N"
    within = f"within the gap of {grasp.search.gap:.3g}"
    if apart > 0:
        found = (
            f"that each is the best of those {1000 * apart:g} mm from the grasps before it, {within}, the search found"
        )
    else:
        found = f"that none better is left out, {within}, the search found"
    if grasp.search.trace and grasp.search.trace[-1].open:
        found = "others may be left out, the search was stopped"
    return f"{bound}; {found}"


def _friction(rigid_object: Graspable, candidates: Candidates) -> str:
    """The coefficients and where they come from."""
    friction = candidates.contacts.friction
    own = np.array([part.friction for part in rigid_object.parts])[candidates.part]
    least, most = friction.min(), friction.max()
    spread = f"{least:g}" if least == most else f"{least:g}–{most:g}"
    return f"{spread} (the object's own)" if (friction == own).all() else spread


def _torsion(problem: GraspProblem) -> str:
    """The torsional friction and who says so."""
    choice, limits = problem.candidates.choice, problem.limits
    if any(finger.twist_is_said for finger in limits.fingers):
        source = " (of the limits)"
    elif choice is not None and choice.patch is not None:
        source = f", that of discs of {in_mm(choice.patch, 3)} mm radius, evenly pressed"
    else:
        source = "" if choice is not None and choice.torsion is not None else " (the object's own)"
    spread = _spread_in_mm(problem.kinds.candidates.contacts.torsions)
    return f"{spread}{source}: soft fingers, torque about the normal up to torsion times normal force"


def _spread_in_mm(lengths: Floats) -> str:
    """The least and the greatest of lengths [m]."""
    least, most = in_mm(lengths.min(), 3), in_mm(lengths.max(), 3)
    return f"{least} mm" if least == most else f"{least} to {most} mm"


def _wrenches(rigid_object: Graspable, task: Task) -> str:
    """How many there are, and in which frame, with how far the file turns it."""
    number = f"{len(task.wrenches)} wrench{'' if len(task.wrenches) == 1 else 'es'}"
    turn = rigid_object.pose_in_file.angle if isinstance(rigid_object, RigidObject) else 0.0
    turned = f", which the file turns by {np.rad2deg(turn):.3g}°" if turn > SEEN_TURN else ""
    return f"{number} in the body frame{turned}, moments about {point_in_mm(task.reference_point)} mm"


def _given(given: GivenMass) -> str:
    """The mass properties that the user gave."""
    mass = [] if given.mass is None else [f"mass {given.mass:g} kg"]
    center = given.center_of_mass
    return ", ".join(mass + ([] if center is None else [f"centre of mass {point_in_mm(center)} mm"]))
