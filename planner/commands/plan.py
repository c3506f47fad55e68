"""`grasp-plan`: from an MJCF object to a grasp file with a proof."""

from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from planner.commands.terminal import ExitCode, Interruption, parse, run

if TYPE_CHECKING:
    from planner.commands.plan_report import Report


@dataclass(frozen=True, kw_only=True)
class Options:
    """Where should the fingers go, and how strong must they be?

    Chooses the contacts on an MJCF object that resist a task with the smallest fingertip force rho, proves that no
    other choice needs less, and writes a grasp file.
    """

    object: tyro.conf.Positional[Path]
    """MJCF file of the object: what MuJoCo collides is what is planned on. Or the .toml file of a planar one."""

    fingers: int = 3
    """How many fingers, 1 to 8."""

    friction: float | None = None
    """Coulomb coefficient of every contact; by default each geom's own."""

    task: str = "gravity"
    """What the grasp must resist: "gravity" is the weight in any direction, the centre of mass somewhere near; "paper"
    is the weight as a force box and the moments of a shifted centre of mass; "axes6" is a push of 10 N per kg each way
    along each axis; anything else is a TOML file."""

    candidates: str = "300"
    """Where fingers may go: a number of evenly spread points; "grid:0.004" for cell centres 4 mm apart on every flat
    facet, or edge of a planar object; "case3" for the paper's 217 points on the prism; anything else is a CSV file of
    points x,y,z (planar: x,y)."""

    out: Path | None = None
    """The grasp file to write; by default OBJECT.grasp.json in the current folder."""

    body: str | None = None
    """Body to grasp, where the file holds several."""

    mass: float | None = None
    """Mass of the object in kg, where its file has none or a wrong one."""

    com: tuple[float, float, float] | None = None
    """Centre of mass in the body frame in metres, where the file's is wrong."""

    fingertip: float | None = None
    """Radius in metres of the fingertip that must fit beside other parts' walls; by default 0.5 % of the object's
    size."""

    decompose: bool = False
    """Cut meshes whose hollows MuJoCo would fill into convex parts, and plan on the file NAME.convex.xml that holds
    them, written beside the grasp file (needs the extra `decompose`)."""

    gap: float = 1e-3
    """Relative gap between rho and its proven lower bound at which to stop."""

    time_limit: float = inf
    """Seconds after which to stop with the best grasp and the gap it has."""

    seed: int = 0
    """Seed of the even candidates and of the search's starts."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


def plan_command(options: Options) -> ExitCode:
    """Plan, write the grasp file, and say what came out."""
    from planner.atomic_write import require_writable  # here: the help must not wait for MuJoCo
    from planner.candidates.choice import make_candidates
    from planner.candidates.confirmed import confirmed_candidates
    from planner.commands.plan_report import Report
    from planner.grasp_file import SUFFIX, write_grasp
    from planner.objects.given_mass import given_mass
    from planner.objects.object_file import read_object_file
    from planner.objects.rigid_object import RigidObject
    from planner.objects.visual import visual_difference, warn_of_difference
    from planner.plan import plan
    from planner.search.certified import CertifiedSearch
    from planner.search.result import Status
    from planner.task import make_task

    out = options.out or Path(options.object.stem + SUFFIX)
    require_writable(out)
    search = CertifiedSearch(gap=options.gap, time_limit=options.time_limit, seed=options.seed)
    report = Report(quiet=options.quiet)
    file = _decomposed(options, out.parent, report) if options.decompose else options.object
    rigid_object = read_object_file(file, options.body, given_mass(options.mass, options.com))
    task = make_task(options.task, rigid_object)
    candidates = make_candidates(rigid_object, options.candidates, options.friction, options.seed, options.fingertip)
    report.problem(rigid_object, task, candidates, options.fingers)
    if isinstance(rigid_object, RigidObject):
        confirmed = confirmed_candidates(rigid_object, candidates)
        candidates = confirmed.candidates
        report.dropped(confirmed)
        warn_of_difference(rigid_object, visual_difference(rigid_object))
    report.header()
    grasp = plan(rigid_object, task, candidates, options.fingers, search, report.progress, Interruption())
    write_grasp(out, grasp)
    report.grasp(grasp, out)
    if grasp.status is Status.OPTIMAL:
        return ExitCode.DONE
    return ExitCode.INFEASIBLE if grasp.status is Status.INFEASIBLE else ExitCode.LIMIT


def _decomposed(options: Options, folder: Path, report: "Report") -> Path:
    """The file to plan on in place of the object's own."""
    from planner.decompose import decompose

    file, parts = decompose(options.object, options.body, folder)
    report.decomposed(file, parts)
    return file


def main() -> None:
    """Entry point of `grasp-plan`."""
    options = parse(Options, "grasp-plan")
    run(lambda: plan_command(options))
