"""`grasp-plan`: from an MJCF object to a grasp file with a proof."""

from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from planner.commands.object_options import ObjectOptions
from planner.terminal.command_line import ExitCode, Given, as_typed, parse, run, write_json
from planner.terminal.console import Console
from planner.terminal.interruption import Interruption, interruption

if TYPE_CHECKING:
    from planner.commands.plan_report import Report
    from planner.grasp_problem import GraspProblem, GraspRequest
    from planner.grasps.grasp import Grasp
    from planner.objects.object_source import ObjectSource
    from planner.terminal.search_log import SearchLog


@dataclass(frozen=True, kw_only=True)
class Options(ObjectOptions):
    """Where should the fingers go, and how strong must they be?

    Chooses the contacts on an MJCF object that resist a task with the smallest fingertip force rho, proves that no
    other choice needs less, and writes a grasp file. For two jaws with pads of 4 mm radius:

        grasp-plan assets/box/box.xml --fingers 2 --patch 0.004
    """

    fingers: int = 3
    """How many fingers, 1 to 8."""

    friction: Given[float] = None
    """Coulomb coefficient of every contact; by default each geom's own."""

    friction_error: float = 0.0
    """Share by which the coefficients may be smaller or larger, for example 0.2; rho then holds for all of them."""

    torsion: Given[float] = None
    """Torsional friction of every contact in metres: the most torque about the normal over the normal force. Two
    fingers need it. By default each geom's own where its condim is 4 or more, else none. For each finger: --limits."""

    patch: Given[float] = None
    """Or the radius in metres of the disc that every fingertip presses flat, for example 0.004: torsional friction is
    then 2/3 friction x radius, that of even pressure."""

    task: str = "gravity"
    """What the grasp must resist: "gravity" is the weight in any direction, the centre of mass somewhere near; "paper"
    is the weight as a force box and the moments of a shifted centre of mass; "axes6" is a push of 10 N per kg each way
    along each axis; anything else is a TOML file, whose forces and moments (N, N m) and reference point (m) are in the
    frame of the body, or, with the line frame = "world", in the world of the object's file; see assets/tasks."""

    candidates: Given[str] = None
    """Where fingers may go: a number of evenly spread points; "antipodal:300" for 150 pairs of opposed points, densest
    about the centre of mass; "grid:0.004" for cell centres 4 mm apart on every flat facet, or edge of a planar object;
    "case3" for the paper's 217 points on the prism; anything else is a CSV file of points x,y,z (planar: x,y) in
    metres, behind each, if wanted, its normal into the object nx,ny,nz; or a *.grasp.json, of whose contacts the places
    are taken. By default antipodal:300 for two fingers on an object in space, otherwise 300."""

    out: Given[Path] = None
    """The grasp file to write; by default OBJECT.grasp.json in the current folder."""

    fingertip: Given[float] = None
    """Radius in metres of the fingertip that must fit beside other parts' walls; by default 0.5 % of the object's
    size."""

    limits: Given[Path] = None
    """TOML file of what the hand allows: where fingers must not touch, the table, room to approach, least and greatest
    distance of two contacts, where each finger may touch, how strong it is and how it resists turning; see
    assets/limits."""

    decompose: bool = False
    """Cut meshes whose hollows MuJoCo would fill into convex parts, and plan on the file NAME.convex.xml that holds
    them, written beside the grasp file (needs the extra `decompose`)."""

    gap: float = 1e-3
    """Relative gap between rho and its proven lower bound at which to stop."""

    keep: int = 1
    """How many grasps to write: the best to OUT, the next ones to OUT's name with .2, .3, ...; none in between is
    missing."""

    within: Given[float] = None
    """Of those, only grasps whose rho exceeds the best by at most this share, for example 0.05."""

    apart: float = 0.0
    """Least distance in metres of some contact of each grasp to all contacts of every grasp before it."""

    time_limit: float = inf
    """Seconds for everything, reading and writing too, after which to stop with the best grasp and the gap it has. The
    clock starts when the program is loaded, which takes a few seconds itself."""

    seed: int = 0
    """Seed of the candidates, where they are evenly spread or in opposed pairs, and of the search's starts."""

    json: bool = False
    """Print one JSON document with the outcome to standard output; words then go to standard error."""

    log_json: Given[Path] = None
    """File for the search log as it happens, one JSON object per line; the last one has the status."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors (and what --json asks for)."""

    @property
    def request(self) -> "GraspRequest":
        """What is asked for.

        Raises:
            ObjectError: If how to read the object is contradictory.
        """
        from planner.grasp_problem import GraspRequest

        return GraspRequest(
            source=self.source,
            task=self.task,
            candidates=self.candidates,
            fingers=self.fingers,
            friction=self.friction,
            friction_error=self.friction_error,
            torsion=self.torsion,
            patch=self.patch,
            fingertip=self.fingertip,
            limits=self.limits,
            seed=self.seed,
        )


def plan_command(options: Options, console: Console, command: str | None = None) -> ExitCode:
    """Plan, write the grasp file, which remembers the command line, and say what came out."""
    console.show("loading MuJoCo and the solvers")
    from planner.commands.plan_report import Report
    from planner.commands.plan_summary import plan_summary
    from planner.commands.with_pads import planned_with_pads
    from planner.files.atomic_write import require_writable  # here: the help must not wait for MuJoCo
    from planner.grasps.grasp_file import SUFFIX, numbered, write_grasp
    from planner.search.result import Status
    from planner.terminal.search_log import SearchLog

    out = options.out or Path(options.object.stem + SUFFIX)
    require_writable(numbered(out, options.keep))  # of all names the longest
    require_writable(out)
    report, ending = Report(console), interruption()
    with SearchLog(console, options.log_json, ending) as log:
        problem, grasps = _plan(options, out.parent, report, log, console, ending)
        ending.keep()
        files = [numbered(out, number) for number in range(1, len(grasps) + 1)]
        documents = [
            write_grasp(file, replace(each, command=command)) for file, each in zip(files, grasps, strict=True)
        ]
        grasp = grasps[0]
        log.end(grasp.status)
    with_pads = None if console.quiet else planned_with_pads(problem, grasp, ending.left, ending)
    report.grasp(grasp, out, with_pads)
    report.others(grasps[1:], files[1:], options.apart)
    if options.json:
        write_json(console, plan_summary(grasp, files, documents))
    if grasp.status is Status.OPTIMAL:
        return ExitCode.DONE
    return ExitCode.INFEASIBLE if grasp.status is Status.INFEASIBLE else ExitCode.LIMIT


def _plan(
    options: Options, folder: Path, report: "Report", log: "SearchLog", console: Console, ending: Interruption
) -> "tuple[GraspProblem, tuple[Grasp, ...]]":
    """Pose the problem, say what it is, and search."""
    from planner.grasp_problem import pose_problem
    from planner.planning import plan_several
    from planner.search.certified import CertifiedSearch

    search = CertifiedSearch(
        gap=options.gap,
        time_limit=options.time_limit,
        keep=options.keep,
        within=options.within,
        apart=options.apart,
        seed=options.seed,
    )
    ending.start_clock(options.time_limit)
    request = options.request
    if options.decompose:
        request = replace(request, source=_decomposed(request.source, folder, report, console))
    problem = pose_problem(request, console.show)
    report.problem(problem)
    log.header()
    search = replace(search, time_limit=ending.left)
    return problem, plan_several(problem, search, log.observe, log.asked(ending.asked))


def _decomposed(source: "ObjectSource", folder: Path, report: "Report", console: Console) -> "ObjectSource":
    """What to plan on in place of the object's own file."""
    from planner.objects.mjcf.decompose import decompose

    console.show("cutting meshes into convex parts")
    source, parts = decompose(source, folder)
    report.decomposed(source.file, parts)
    return source


def main() -> None:
    """Entry point of `grasp-plan`."""
    options = parse(Options, "grasp-plan")
    console = Console(quiet=options.quiet, json=options.json)
    run(lambda: plan_command(options, console, as_typed("grasp-plan")), console)
