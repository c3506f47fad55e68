"""What `grasp-plan` says while it works and when it is done."""

from pathlib import Path

import numpy as np

from planner.candidates.candidates import Candidates
from planner.candidates.confirmed import Confirmed
from planner.grasp import Grasp
from planner.objects.given_mass import GivenMass
from planner.objects.graspable import Graspable
from planner.objects.rigid_object import RigidObject
from planner.search.result import Progress, Status
from planner.task import Task

HEADER = (
    f"{'Nodes':>10} {'Open':>8} {'LowerBound':>11} {'Incumbent':>11} {'Gap':>9} {'SOCPs':>8} {'Cuts':>6} {'Time':>8}"
)


class Report:
    """Prints to standard output, unless quiet."""

    def __init__(self, *, quiet: bool) -> None:
        self._quiet = quiet

    def problem(self, rigid_object: Graspable, task: Task, candidates: Candidates, fingers: int) -> None:
        """What is about to be searched."""
        extent = " x ".join(f"{1000 * edge:.4g}" for edge in rigid_object.extent)
        self._say(
            f"object      {rigid_object.file}, body {rigid_object.body!r}: {rigid_object.mass:.4g} kg, {extent} mm"
        )
        if isinstance(rigid_object, RigidObject) and not rigid_object.given.nothing:
            self._say(f"given       {_given(rigid_object.given)}, in place of the file's")
        self._say(f"task        {task.name}: {len(task.wrenches)} wrenches")
        self._say(f"candidates  {len(candidates)}, friction {_friction(rigid_object, candidates)}; {fingers} fingers")

    def decomposed(self, file: Path, parts: int) -> None:
        """What is planned on in place of the object's file."""
        self._say(f"decomposed  {file}: {parts} convex parts")

    def dropped(self, confirmed: Confirmed) -> None:
        """Candidates that MuJoCo does not confirm, if there are any."""
        if confirmed.dropped:
            self._say(
                f"dropped     {confirmed.dropped} candidates that MuJoCo does not confirm: {confirmed.off_surface} off "
                f"its surface, {confirmed.turned} with another normal, {confirmed.crowded} touching another part; "
                f"{len(confirmed.candidates)} are left"
            )

    def header(self) -> None:
        """The head of the search log."""
        self._say()
        self._say(HEADER)

    def progress(self, line: Progress) -> None:
        """One line of the search log."""
        incumbent = f"{line.incumbent:11.5g}" if line.incumbent < float("inf") else f"{'-':>11}"
        gap = f"{line.gap:9.2%}" if line.gap < float("inf") else f"{'-':>9}"
        self._say(
            f"{line.nodes:10d} {line.open:8d} {line.lower_bound:11.5g} {incumbent} {gap} "
            f"{line.socp_solves:8d} {line.cuts:6d} {line.seconds:7.2f}s"
        )

    def grasp(self, grasp: Grasp, out: Path) -> None:
        """The outcome and where it was written."""
        self._say()
        if grasp.status is Status.INFEASIBLE:
            self._infeasible(grasp)
        elif not grasp.found:
            self._say("no grasp found yet; allow more time")
        else:
            self._contacts(grasp)
        self._say(f"wrote       {out} and {out.with_suffix('.npz').name}")

    def _contacts(self, grasp: Grasp) -> None:
        self._say(f"rho         {grasp.rho:.6g} N: every finger must be able to push this hard ({grasp.status})")
        self._say(
            f"proof       no {grasp.search.fingers} of the {grasp.search.candidates} candidates "
            f"({grasp.search.subsets:,} subsets) need less than {grasp.lower_bound:.6g} N (gap {grasp.gap:.3%})"
        )
        for number, (point, geom) in enumerate(zip(grasp.contacts.points, grasp.geoms, strict=True), start=1):
            position = " ".join(f"{1000 * coordinate:9.3f}" for coordinate in point)
            self._say(f"contact {number}   {position} mm on {geom}")

    def _infeasible(self, grasp: Grasp) -> None:
        self._say(
            f"infeasible  proven: no {grasp.search.fingers} of the {grasp.search.candidates} candidates resist "
            f"the task with less than {grasp.lower_bound:.3g} N per finger"
        )
        if len(grasp.certificate.cuts) == 1:
            direction = " ".join(f"{value:.3g}" for value in grasp.certificate.cuts[0])
            self._say(f"direction   ({direction}): no contact can push the object along it, and the task asks for it")
        elif grasp.search.fingers == 2 and not len(grasp.certificate.cuts):
            self._say("direction   the moment about the line through the two contacts, whichever they are")

    def _say(self, text: str = "") -> None:
        if not self._quiet:
            print(text, flush=True)


def _friction(rigid_object: Graspable, candidates: Candidates) -> str:
    """The coefficients and where they come from."""
    friction = candidates.contacts.friction
    own = np.array([part.friction for part in rigid_object.parts])[candidates.part]
    least, most = friction.min(), friction.max()
    spread = f"{least:g}" if least == most else f"{least:g}–{most:g}"
    return f"{spread} (the object's own)" if (friction == own).all() else spread


def _given(given: GivenMass) -> str:
    """The mass properties that the user gave."""
    mass = [] if given.mass is None else [f"mass {given.mass:g} kg"]
    center = given.center_of_mass
    return ", ".join(mass + ([] if center is None else [f"centre of mass ({_millimetres(center)}) mm"]))


def _millimetres(point: np.ndarray) -> str:
    return ", ".join(f"{1000 * coordinate:.4g}" for coordinate in point)
