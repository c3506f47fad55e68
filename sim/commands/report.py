"""`grasp-report`: a grasp, its proof and its measurement as one HTML page that works offline."""

from dataclasses import dataclass
from pathlib import Path

import tyro

from planner.commands.terminal import ExitCode, parse, run


@dataclass(frozen=True, kw_only=True)
class Options:
    """Make one self-contained HTML page per grasp file: look at the grasp before you believe it.

    The object in 3-D with contacts, friction cones and the forces for every wrench of the task; rho with its proven
    bound; and, where there is a validation file, what MuJoCo measured. The page needs no network.
    """

    files: tyro.conf.Positional[tuple[Path, ...]]
    """One or more *.grasp.json; their side files must be beside them."""

    out: Path | None = None
    """The page to write, for a single file; by default NAME.report.html in the current folder."""

    validation: Path | None = None
    """The validation file, for a single file; by default NAME.validation.json beside it or in the current folder."""

    object: Path | None = None
    """Where the object's file is now, if it has moved, for a single file."""


def report_command(options: Options) -> ExitCode:
    """Write one page per file and say so."""
    from planner.errors import OutputError  # here: the help must not wait for MuJoCo
    from planner.grasp_file import SUFFIX

    if not options.files:
        raise OutputError("no grasp file named; name one or more *.grasp.json")
    if len(options.files) > 1 and (options.out or options.validation or options.object):
        raise OutputError(f"--out, --validation and --object are for a single file; {len(options.files)} are named")
    for file in options.files:
        name = file.name.removesuffix(SUFFIX)
        out = options.out or Path(f"{name}.report.html")
        places = (file.with_name(f"{name}.validation.json"), Path(f"{name}.validation.json"))
        validation = options.validation or next((place for place in places if place.is_file()), None)
        _report(file, out, validation, options.object)
        print(f"wrote       {out}" + (f" with {validation}" if validation else " (no validation found)"))
    return ExitCode.DONE


def _report(file: Path, out: Path, validation: Path | None, moved: Path | None) -> None:
    import msgspec

    from planner.exports.report_page import write_report
    from planner.grasp_file import read_grasp
    from planner.grasped_object import read_grasped_object
    from sim.validation_reader import read_validation_of

    grasp = read_grasp(file)
    document = msgspec.to_builtins(read_validation_of(validation, grasp)) if validation else None
    write_report(out, read_grasped_object(grasp, moved), grasp, file.name, document)


def main() -> None:
    """Entry point of `grasp-report`."""
    options = parse(Options, "grasp-report")
    run(lambda: report_command(options))
