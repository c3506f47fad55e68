"""`grasp-convert`: a grasp file in a form that other programs read."""

from dataclasses import dataclass
from pathlib import Path

import tyro

from planner.terminal.command_line import ExitCode, Given, parse, run

HAND = ".npy"
"""Ending of a foreign grasp of a whole hand."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """Convert a grasp file; the ending of the output says to what.

    .glb is a 3-D scene with the object, the contacts, their friction cones and the forces for one wrench,
    and the torques of soft fingers.
    .isaac.yaml (or .yaml) is an isaac_grasp file with one contact frame per fingertip; forces, torques
    and friction, which that format does not know, stand beside it.
    .graspgen.json and .npy (DexGraspBench) hold whole hands, so fingertips are refused, with the reason.

    A DexGraspBench .npy can be converted to .isaac.yaml and, if it says whether it held, to .graspgen.json.
    """

    file: tyro.conf.Positional[Path]
    """A *.grasp.json; or a DexGraspBench *.npy, whose pickle is not run."""

    out: Path
    """The file to write."""

    wrench: Given[int] = None
    """Number of the wrench whose forces and torques to show, from 0 as in the file; by default the critical one."""

    object: Given[Path] = None
    """Where the object's file is now, if it has moved."""


def convert_command(options: Options) -> ExitCode:
    """Convert and say what was written."""
    from planner.errors import GraspFileError, OutputError  # here: the help must not wait for trimesh
    from planner.exchange.dexgraspbench import read_hand
    from planner.exchange.formats import format_of
    from planner.grasps.grasp_file import read_grasp
    from planner.grasps.grasped_object import read_grasped_object

    format = format_of(options.out)
    if options.file.suffix.lower() == HAND:
        if format.hand is None:
            raise OutputError(f"{options.file} is a grasp of a hand, which {format.ending} does not hold")
        format.hand(options.out, read_hand(options.file))
    else:
        grasp = read_grasp(options.file)
        if not grasp.found:
            raise GraspFileError(
                f"{options.file} holds no grasp (status {grasp.status}): there is nothing to convert; grasp-report "
                "shows the candidates and what is proven about them"
            )
        format.fingertips(options.out, read_grasped_object(grasp, options.object), grasp, options.wrench)
    print(f"wrote       {options.out}")
    return ExitCode.DONE


def main() -> None:
    """Entry point of `grasp-convert`."""
    options = parse(Options, "grasp-convert")
    run(lambda: convert_command(options))
