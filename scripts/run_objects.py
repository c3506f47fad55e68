"""Every object of a folder, planned and validated with several numbers of fingers on several tasks: one table.

    python scripts/run_objects.py                      # this project's own objects
    python scripts/run_objects.py DIR --out objects.md
    python scripts/run_objects.py --fingers 2 --tasks gravity --patch 0.004

An object is a folder's MJCF file that no other file of the folder includes. Exits non-zero if any verdict is not pass
or anything cannot be read.
"""

import logging
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from time import perf_counter
from typing import Annotated, NamedTuple
from xml.etree import ElementTree

import mujoco
import tyro

from planner.errors import ObjectError, RhograspError
from planner.files.atomic_write import require_writable, write_atomically
from planner.grasp_problem import GraspRequest, pose_problem
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable
from planner.objects.object_source import ObjectSource
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.search.result import Status
from planner.terminal.command_line import ExitCode, parse, run
from planner.terminal.console import Console
from sim.validation.validation import Validation, validate

ASSETS = Path(__file__).resolve().parents[1] / "assets"
HEADER = "| object | task | fingers | candidates | rho [N] | gap | plan [s] | verdict | measured / predicted rho |"


@dataclass(frozen=True, kw_only=True)
class Options:
    """Plan and validate every object of a folder, by default with 3 and 4 fingers on two tasks, and print a table."""

    folder: tyro.conf.Positional[Path] = ASSETS
    """Folder of objects, one in each of its folders; by default this project's own."""

    fingers: tuple[int, ...] = (3, 4)
    """Numbers of fingers."""

    tasks: tuple[str, ...] = ("gravity", "paper")
    """Tasks, as `grasp-plan` takes them."""

    candidates: str | None = None
    """Where fingers may go, as `grasp-plan` takes it."""

    patch: float | None = None
    """Radius in metres of the disc that every fingertip presses flat; by default fingers are hard."""

    time_limit: float = 300.0
    """Seconds after which a search stops with the gap it has."""

    measure: bool = True
    """Measure rho by bisection, beside the verdict."""

    out: Path | None = None
    """Markdown file to write the table to."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


class Row(NamedTuple):
    """One line of the table, and whether it is as it should be."""

    text: str
    good: bool


def objects(folder: Path) -> list[Path]:
    """Files that hold objects: in each folder, those MJCF files that no other file of it depends on.

    Raises:
        ObjectError: If there is none.
    """
    if not folder.is_dir():
        raise ObjectError(f"there is no folder '{folder}'; name one that holds a folder for each object")
    found = []
    for home in sorted(path for path in folder.iterdir() if path.is_dir()):
        files = {path.resolve() for path in home.rglob("*.xml")}
        included = {name for path in files for name in _included(path)}
        found += sorted(files - included)
    if not found:
        raise ObjectError(f"no folder in '{folder}' holds an MJCF file")
    return found


def _included(path: Path) -> set[Path]:
    """What a file depends on; a fragment, which is no model by itself, names itself."""
    try:
        fragment = ElementTree.parse(path).getroot().tag == "mujocoinclude"
        needed = {Path(name).resolve() for name in mujoco.mju_getXMLDependencies(str(path))}
    except (ElementTree.ParseError, mujoco.FatalError):
        return set()  # a broken file becomes a row that says so
    return needed if fragment else needed - {path}


def rows(path: Path, options: Options) -> Iterator[Row]:
    """The lines of an object, or one with the reason why there are none, or no more."""
    name = path.relative_to(options.folder.resolve()).parts[0]
    try:
        for task, fingers in product(options.tasks, options.fingers):
            request = GraspRequest(
                source=ObjectSource(file=path),
                task=task,
                candidates=options.candidates,
                fingers=fingers,
                patch=options.patch,
            )
            problem = pose_problem(request)
            began = perf_counter()
            grasp = plan(problem, CertifiedSearch(time_limit=options.time_limit))
            yield row(f"{name} | {task} | {fingers}", problem.rigid_object, grasp, perf_counter() - began, options)
    except RhograspError as error:
        yield Row(f"| {name} | {error} |", good=False)


def row(label: str, rigid_object: Graspable, grasp: Grasp, seconds: float, options: Options) -> Row:
    """One grasp, validated."""
    left = f"| {label} | {grasp.search.candidates}"
    if not grasp.found:
        proven = grasp.status is Status.INFEASIBLE
        return Row(f"{left} | {grasp.status} | | {seconds:.2f} | | |", good=proven)
    validation = validate(rigid_object, grasp, measure=options.measure)
    text = (
        f"{left} | {grasp.rho:.4g} | {grasp.gap:.2%} | {seconds:.2f} | {validation.verdict} | {measured(validation)} |"
    )
    return Row(text, good=bool(validation.verdict) and grasp.status is Status.OPTIMAL)


def measured(validation: Validation) -> str:
    """The measured rho over the predicted one."""
    return "" if validation.critical_force is None else f"{validation.critical_force.ratio:.4f}"


def run_objects(options: Options, console: Console) -> ExitCode:
    """Print the table row by row, and save it."""
    logging.getLogger("planner.objects").setLevel(logging.ERROR)  # warnings are what grasp-inspect is for
    if options.out is not None:
        require_writable(options.out)
    lines, good = [HEADER, "|---" * HEADER.count(" | ") + "|---|"], True
    console.say("\n".join(lines))
    files, per_object = objects(options.folder), len(options.tasks) * len(options.fingers)
    for number, path in enumerate(files):
        console.count(f"grasps ({path.stem})", number * per_object, len(files) * per_object)
        for done, each in enumerate(rows(path, options), start=number * per_object + 1):
            console.say(each.text)
            console.count(f"grasps ({path.stem})", done, len(files) * per_object)
            lines.append(each.text)
            good &= each.good
    if options.out is not None:
        write_atomically(options.out, "\n".join([*lines, ""]).encode())
    return ExitCode.DONE if good else ExitCode.FAILED


if __name__ == "__main__":
    options = parse(Options, "run_objects.py")
    console = Console(quiet=options.quiet)
    run(lambda: run_objects(options, console), console)
