"""`grasp-plan`: from an MJCF object to a grasp file with a proof."""

from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from planner.commands.console import Console
from planner.commands.interruption import Interruption, interruption
from planner.commands.object_options import ObjectOptions
from planner.commands.terminal import ExitCode, as_typed, parse, run, write_json

if TYPE_CHECKING:
    from planner.candidates.candidates import Candidates
    from planner.commands.plan_report import Report
    from planner.commands.search_log import SearchLog
    from planner.grasp import Grasp
    from planner.limits.kinds import Kinds
    from planner.limits.limits import Limits
    from planner.objects.graspable import Graspable
    from planner.objects.object_source import ObjectSource


@dataclass(frozen=True, kw_only=True)
class Options(ObjectOptions):
    """Where should the fingers go, and how strong must they be?

    Chooses the contacts on an MJCF object that resist a task with the smallest fingertip force rho, proves that no
    other choice needs less, and writes a grasp file.
    """

    fingers: int = 3
    """How many fingers, 1 to 8."""

    friction: float | None = None
    """Coulomb coefficient of every contact; by default each geom's own."""

    friction_error: float = 0.0
    """Share by which the coefficients may be smaller or larger, for example 0.2; rho then holds for all of them."""

    task: str = "gravity"
    """What the grasp must resist: "gravity" is the weight in any direction, the centre of mass somewhere near; "paper"
    is the weight as a force box and the moments of a shifted centre of mass; "axes6" is a push of 10 N per kg each way
    along each axis; anything else is a TOML file, whose forces and moments (N, N m) and reference point (m) are in the
    frame of the body, or, with the line frame = "world", in the world of the object's file; see assets/tasks."""

    candidates: str = "300"
    """Where fingers may go: a number of evenly spread points; "grid:0.004" for cell centres 4 mm apart on every flat
    facet, or edge of a planar object; "case3" for the paper's 217 points on the prism; anything else is a CSV file of
    points x,y,z (planar: x,y) in metres, behind each, if wanted, its normal into the object nx,ny,nz; or a
    *.grasp.json, whose contacts are taken."""

    out: Path | None = None
    """The grasp file to write; by default OBJECT.grasp.json in the current folder."""

    fingertip: float | None = None
    """Radius in metres of the fingertip that must fit beside other parts' walls; by default 0.5 % of the object's
    size."""

    limits: Path | None = None
    """TOML file of what the hand allows: where fingers must not touch, the table, room to approach, least and greatest
    distance of two contacts, where each finger may touch and how strong it is; see assets/limits."""

    decompose: bool = False
    """Cut meshes whose hollows MuJoCo would fill into convex parts, and plan on the file NAME.convex.xml that holds
    them, written beside the grasp file (needs the extra `decompose`)."""

    gap: float = 1e-3
    """Relative gap between rho and its proven lower bound at which to stop."""

    keep: int = 1
    """How many grasps to write: the best to OUT, the next ones to OUT's name with .2, .3, ...; none in between is
    missing."""

    within: float | None = None
    """Of those, only grasps whose rho exceeds the best by at most this share, for example 0.05."""

    apart: float = 0.0
    """Least distance in metres of some contact of each grasp to all contacts of every grasp before it."""

    time_limit: float = inf
    """Seconds for everything, reading and writing too, after which to stop with the best grasp and the gap it has. The
    clock starts when the program is loaded, which takes a few seconds itself."""

    seed: int = 0
    """Seed of the even candidates and of the search's starts."""

    json: bool = False
    """Print one JSON document with the outcome to standard output; words then go to standard error."""

    log_json: Path | None = None
    """File for the search log as it happens, one JSON object per line; the last one has the status."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors (and what --json asks for)."""


def plan_command(options: Options, console: Console, command: str | None = None) -> ExitCode:
    """Plan, write the grasp file, which remembers the command line, and say what came out."""
    console.show("loading MuJoCo and the solvers")
    from planner.atomic_write import require_writable  # here: the help must not wait for MuJoCo
    from planner.commands.plan_report import Report
    from planner.commands.plan_summary import plan_summary
    from planner.commands.search_log import SearchLog
    from planner.grasp_file import SUFFIX, numbered, write_grasp
    from planner.search.result import Status

    out = options.out or Path(options.object.stem + SUFFIX)
    require_writable(numbered(out, options.keep))  # of all names the longest
    require_writable(out)
    report, ending = Report(console), interruption()
    with SearchLog(console, options.log_json, ending) as log:
        grasps = _plan(options, out.parent, report, log, console, ending)
        ending.keep()
        files = [numbered(out, number) for number in range(1, len(grasps) + 1)]
        for file, each in zip(files, grasps, strict=True):
            write_grasp(file, replace(each, command=command))
        grasp = grasps[0]
        log.end(grasp.status)
    report.grasp(grasp, out)
    report.others(grasps[1:], files[1:], options.apart)
    if options.json:
        write_json(console, plan_summary(files))
    if grasp.status is Status.OPTIMAL:
        return ExitCode.DONE
    return ExitCode.INFEASIBLE if grasp.status is Status.INFEASIBLE else ExitCode.LIMIT


def _plan(
    options: Options, folder: Path, report: "Report", log: "SearchLog", console: Console, ending: Interruption
) -> "tuple[Grasp, ...]":
    """Read the object, choose the candidates and search."""
    from planner.candidates.choice import make_candidates
    from planner.candidates.confirmed import confirmed_candidates
    from planner.objects.object_file import read_object_file
    from planner.objects.rigid_object import RigidObject
    from planner.objects.visual import visual_difference, warn_of_difference
    from planner.planning import plan_within
    from planner.search.certified import CertifiedSearch
    from planner.task import make_task

    search = CertifiedSearch(
        gap=options.gap,
        time_limit=options.time_limit,
        keep=options.keep,
        within=options.within,
        apart=options.apart,
        seed=options.seed,
    )
    ending.start_clock(options.time_limit)
    source = _decomposed(options, folder, report, console) if options.decompose else options.source
    console.show(f"reading {source.file}")
    rigid_object = read_object_file(source)
    task = make_task(options.task, rigid_object)
    console.show(f"choosing candidates: {options.candidates}")
    candidates = make_candidates(rigid_object, options.candidates, options.friction, options.seed, options.fingertip)
    candidates = candidates.least_friction(options.friction_error)
    report.problem(rigid_object, task, candidates, options.fingers)
    if isinstance(rigid_object, RigidObject):
        console.show(f"confirming {len(candidates)} candidates with MuJoCo")
        confirmed = confirmed_candidates(rigid_object, candidates)
        candidates = confirmed.candidates
        report.dropped(confirmed)
        console.show("comparing what is seen with what collides")
        warn_of_difference(rigid_object, visual_difference(rigid_object))
    limits, kinds = _within_limits(options, rigid_object, candidates, report)
    log.header()
    search = replace(search, time_limit=ending.left)
    return plan_within(rigid_object, task, kinds, limits, search, log.observe, log.asked(ending.asked))


def _decomposed(options: Options, folder: Path, report: "Report", console: Console) -> "ObjectSource":
    """What to plan on in place of the object's own file."""
    from planner.decompose import decompose

    console.show("cutting meshes into convex parts")
    source, parts = decompose(options.source, folder)
    report.decomposed(source.file, parts)
    return source


def _within_limits(
    options: Options, rigid_object: "Graspable", candidates: "Candidates", report: "Report"
) -> "tuple[Limits, Kinds]":
    """The limits of a file, none by default, and the candidates that they leave to each finger."""
    from planner.limits.kinds import finger_kinds
    from planner.limits.limits import Limits
    from planner.limits.limits_file import read_limits
    from planner.limits.restricted import restricted
    from planner.source_file import source_file

    limits = Limits()
    if options.limits:
        limits = read_limits(options.limits, rigid_object)
        candidates = candidates.chosen(limits=source_file(options.limits))
    allowed = restricted(rigid_object, candidates, limits)
    report.restricted(allowed)
    kinds = finger_kinds(rigid_object, allowed.candidates, options.fingers, limits)
    report.kinds(kinds)
    report.choice(len(allowed.candidates), options.fingers)
    return limits, kinds


def main() -> None:
    """Entry point of `grasp-plan`."""
    options = parse(Options, "grasp-plan")
    console = Console(quiet=options.quiet, json=options.json)
    run(lambda: plan_command(options, console, as_typed("grasp-plan")), console)
