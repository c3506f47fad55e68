"""`grasp-report`: a grasp, its proof and its measurement as one HTML page that works offline."""

import webbrowser
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tyro

from planner.terminal.command_line import ExitCode, Given, parse, run

if TYPE_CHECKING:
    from planner.grasps.grasp import Grasp


@dataclass(frozen=True, kw_only=True)
class Options:
    """Make one self-contained HTML page per grasp file: look at the grasp before you believe it.

    The object in 3-D with contacts, friction cones and the forces for every wrench of the task; rho with its proven
    bound, the search and how to repeat it; and, where there is a validation file, what MuJoCo measured. Where no grasp
    was found, the candidates and what is proven about them. The page needs no network.
    """

    files: tyro.conf.Positional[tuple[Path, ...]]
    """One or more *.grasp.json."""

    out: Given[Path] = None
    """The page to write, for a single file; by default NAME.report.html in the current folder."""

    validation: Given[Path] = None
    """The validation file, for a single file; by default NAME.validation.json beside it or in the current folder."""

    object: Given[Path] = None
    """Where the object's file is now, if it has moved, for a single file."""

    open: bool = False
    """Open the page in a browser."""


def report_command(options: Options) -> ExitCode:
    """Write one page per file and say so."""
    from planner.errors import OutputError  # here: the help must not wait for MuJoCo
    from planner.grasps.grasp_file import SUFFIX

    if not options.files:
        raise OutputError("no grasp file named; name one or more *.grasp.json")
    if len(options.files) > 1 and (options.out or options.validation or options.object):
        raise OutputError(f"--out, --validation and --object are for a single file; {len(options.files)} are named")
    for file in options.files:
        out = options.out or Path(f"{file.name.removesuffix(SUFFIX)}.report.html")
        note = _report(file, out, options.validation, options.object)
        print(f"wrote       {out}{note}")
        if options.open:
            webbrowser.open(out.resolve().as_uri())
    return ExitCode.DONE


def _report(file: Path, out: Path, given: Path | None, moved: Path | None) -> str:
    """Write one page; returns what to add to the message."""
    from planner.errors import GraspFileError
    from planner.grasps.grasp_file import read_grasp
    from planner.grasps.grasped_object import read_grasped_object
    from sim.report.report_page import write_report

    grasp = read_grasp(file)
    if given and not grasp.found:
        raise GraspFileError(f"{file} holds no grasp (status {grasp.status}), so {given} is not about it")
    validation = given or (_validation_of(file) if grasp.found else None)
    document = _document(validation, grasp) if validation else None
    write_report(out, read_grasped_object(grasp, moved), grasp, file.name, document)
    if not grasp.found:
        return f" (no grasp: {grasp.status})"
    return f" with {validation}" if validation else " (no validation found)"


def _document(validation: Path, grasp: "Grasp") -> dict[str, Any]:
    """The content of a validation file, which is of this grasp."""
    import msgspec

    from sim.validation.document import read_validation_of  # here: a page without a measurement needs no simulator

    content: dict[str, Any] = msgspec.to_builtins(read_validation_of(validation, grasp))
    return content


def _validation_of(file: Path) -> Path | None:
    """The validation file of a grasp file, beside it or in the current folder."""
    from planner.grasps.grasp_file import SUFFIX

    name = f"{file.name.removesuffix(SUFFIX)}.validation.json"
    return next((place for place in (file.with_name(name), Path(name)) if place.is_file()), None)


def main() -> None:
    """Entry point of `grasp-report`."""
    options = parse(Options, "grasp-report")
    run(lambda: report_command(options))
