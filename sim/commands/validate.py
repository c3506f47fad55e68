"""`grasp-validate`: is a grasp file true in MuJoCo?"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from planner.commands.terminal import ExitCode, parse, run


@dataclass(frozen=True, kw_only=True)
class Options:
    """Put fingertips on the planned contacts in MuJoCo, push with every wrench of the task, and see what slips.

    The verdict is pass when every wrench is held with the finger force capped at 1.02 rho, and the critical wrench
    slips with the cap at 0.98 rho.
    """

    file: tyro.conf.Positional[Path]
    """A *.grasp.json; its side file must be beside it."""

    out: Path | None = None
    """The result to write; by default NAME.validation.json in the current folder."""

    object: Path | None = None
    """Where the object's MJCF file is now, if it has moved."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


def validate_command(options: Options) -> ExitCode:
    """Validate, write the result, and say what came out."""
    from planner.atomic_write import require_writable  # here: the help must not wait for MuJoCo
    from planner.errors import GraspFileError
    from planner.grasp_file import SUFFIX, read_grasp
    from planner.grasped_object import read_grasped_object
    from sim.commands.validation_report import summary
    from sim.validate import validate
    from sim.validation_file import write_validation

    out = options.out or Path(options.file.name.removesuffix(SUFFIX) + ".validation.json")
    require_writable(out)
    grasp = read_grasp(options.file)
    if not grasp.found:
        raise GraspFileError(f"{options.file} holds no grasp (status {grasp.status}): there is nothing to validate")
    validation = validate(
        read_grasped_object(grasp, options.object),
        grasp.contacts,
        grasp.task.reference_point,
        grasp.task.wrenches,
        grasp.rho,
        grasp.critical_wrench,
        grasp.phi,
    )
    write_validation(out, validation, grasp=options.file.name)
    if not options.quiet:
        print("\n".join(summary(validation)))
        print(f"wrote       {out}")
    return ExitCode.DONE if validation.verdict else ExitCode.FAILED


def main() -> None:
    """Entry point of `grasp-validate`."""
    options = parse(Options, "grasp-validate")
    run(lambda: validate_command(options))
