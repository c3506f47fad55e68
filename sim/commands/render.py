"""`grasp-render`: pictures and films of a grasp's validation in MuJoCo."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from planner.terminal.command_line import ExitCode, Given, parse, run
from planner.terminal.console import Console


@dataclass(frozen=True, kw_only=True)
class Options:
    """Watch MuJoCo measure rho: the same wrench with the finger forces capped at 1.02 rho, and at 0.98 rho.

    The film shows every instant of the simulation that `grasp-validate` judges, ten times slower, with the contacts,
    their friction cones and the measured forces. On the left the grasp holds, on the right it slips; how far the
    fingertips slipped is drawn below. What happens is small: the picture says how many times larger it is drawn.
    Needs the extra `render` and OpenGL, but no display.
    """

    file: tyro.conf.Positional[Path]
    """A *.grasp.json."""

    out: tuple[Path, ...] = ()
    """What to draw: a still of the end (.png), or a film (.gif, .mp4); by default NAME.png and NAME.gif in the current
    folder."""

    wrench: Given[int] = None
    """Which wrench of the task pushes; by default the critical one, which needs rho. Another one needs phi, and is
    shown with the cap at 1.02 phi and 0.98 phi."""

    size: tuple[int, int] = (960, 540)
    """Width and height [pixels]."""

    view: Given[tuple[float, float]] = None
    """Azimuth of the camera's sight, and how far it looks down [degrees]; by default where the contacts are seen
    best."""

    object: Given[Path] = None
    """Where the object's file is now, if it has moved."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


def render_command(options: Options, console: Console) -> ExitCode:
    """Simulate, draw, write, and say what was seen."""
    console.show("loading MuJoCo and OpenGL")
    from sim.render.needs import require_drawing  # here: the help must not wait for MuJoCo

    require_drawing()  # before anything else imports MuJoCo
    from planner.files.atomic_write import require_writable
    from planner.grasps.grasp_file import SUFFIX, read_grasp
    from planner.grasps.grasped_object import read_grasped_object
    from planner.grasps.lift import in_space
    from sim.render.film import format_of, write_pictures
    from sim.render.picture import Picture, heading_of
    from sim.render.recording import record

    name = options.file.name.removesuffix(SUFFIX)
    files = options.out or (Path(f"{name}.png"), Path(f"{name}.gif"))
    for file in files:
        format_of(file).require()
        require_writable(file)
    grasp = read_grasp(options.file)
    rigid_object, grasp = in_space(read_grasped_object(grasp, options.object), grasp)
    console.show("simulating")
    recording = record(rigid_object, grasp, options.wrench)
    heading = heading_of(name, grasp, recording)
    with Picture(rigid_object, recording, heading, options.size, options.view) as picture:
        for file in files:
            write_pictures(file, picture, console.count)
    console.say("\n".join(f"{'' if row else 'shown':12s}{line}" for row, line in enumerate(recording.summary())))
    console.say("\n".join(f"wrote       {file}" for file in files))
    return ExitCode.DONE if recording.as_predicted else ExitCode.FAILED


def main() -> None:
    """Entry point of `grasp-render`."""
    options = parse(Options, "grasp-render")
    console = Console(quiet=options.quiet)
    run(lambda: render_command(options, console), console)
