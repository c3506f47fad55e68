"""`grasp-convert`: a grasp file in a form that other programs read."""

from dataclasses import dataclass
from pathlib import Path

import tyro

from planner.commands.terminal import ExitCode, parse, run


@dataclass(frozen=True, kw_only=True)
class Options:
    """Convert a grasp file; the ending of the output says to what.

    .glb is a 3-D scene with the object, the contacts, their friction cones and the forces for one wrench.
    """

    file: tyro.conf.Positional[Path]
    """A *.grasp.json; its side file must be beside it."""

    out: Path
    """The file to write: NAME.glb."""

    wrench: int | None = None
    """Which wrench's forces to show; by default the critical one."""

    object: Path | None = None
    """Where the object's file is now, if it has moved."""


def convert_command(options: Options) -> ExitCode:
    """Convert and say what was written."""
    from planner.errors import OutputError  # here: the help must not wait for trimesh
    from planner.exports.glb import write_glb
    from planner.grasp_file import read_grasp
    from planner.grasped_object import read_grasped_object

    if options.out.suffix != ".glb":
        raise OutputError(f"cannot convert to {options.out.suffix or options.out}; the output must end in .glb")
    grasp = read_grasp(options.file)
    write_glb(options.out, read_grasped_object(grasp, options.object), grasp, options.wrench)
    print(f"wrote       {options.out}")
    return ExitCode.DONE


def main() -> None:
    """Entry point of `grasp-convert`."""
    options = parse(Options, "grasp-convert")
    run(lambda: convert_command(options))
