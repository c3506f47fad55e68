"""`grasp-view`: grasps and their trials in MuJoCo, live in a browser."""

import os
import sys
import webbrowser
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from planner.terminal.command_line import ExitCode, Given, parse, run
from planner.terminal.console import Console
from planner.terminal.interruption import signals_as_exceptions


@dataclass(frozen=True, kw_only=True)
class Options:
    """Look at grasps in a browser, and turn them: the plan, and what MuJoCo makes of it.

    The object with its numbered contacts, friction cones and the planned forces for any wrench of the task; and the
    trial of that wrench as `grasp-validate` judges it, with the cap at 1.02 rho, where the grasp holds, and at 0.98
    rho, where it slips, ten times slower, with measured forces and slip. Runs until Ctrl-C. Needs the extra `viz`.
    """

    files: tyro.conf.Positional[tuple[Path, ...]]
    """One or more *.grasp.json."""

    trial: bool = False
    """Begin with the trial."""

    port: Given[int] = None
    """Port of the page; by default 8080, or any free one where that is taken."""

    host: str = "127.0.0.1"
    """Address to listen on. Only this machine can see the default; 0.0.0.0 shows the page to everyone who can reach
    this machine, without a password."""

    open: bool = True
    """Open a browser, where there is a screen."""

    object: Given[Path] = None
    """Where the object's file is now, if it has moved, for a single file."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


def view_command(options: Options, console: Console) -> ExitCode:
    """Read, serve, and draw until Ctrl-C."""
    console.show("loading MuJoCo and viser")
    from planner.errors import SettingError  # here: the help must not wait for MuJoCo
    from sim.view.needs import require_viser

    if not options.files:
        raise SettingError("no grasp file named; name one or more *.grasp.json")
    if len(options.files) > 1 and options.object:
        raise SettingError(f"--object is for a single file; {len(options.files)} are named")
    require_viser()
    from sim.view.server import address, serve
    from sim.view.subject import read_subject
    from sim.view.viewer import Viewer

    subjects = [read_subject(file, options.object) for file in options.files]
    server = serve(options.host, options.port)
    signals_as_exceptions()  # Ctrl-C is how this command ends
    try:
        viewer = Viewer(server, subjects, trial=options.trial)
        viewer.refresh(0.0)  # so that the page has everything from the beginning
        console.say(f"view        {address(server)} (Ctrl-C ends it)")
        if options.open and _has_screen():
            webbrowser.open(address(server))
        viewer.run()
    except KeyboardInterrupt:
        console.show("closing the page")
    finally:
        server.stop()
    return ExitCode.DONE


def _has_screen() -> bool:
    """Without one, Python would open a browser for terminals in this one."""
    return sys.platform != "linux" or any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"))


def main() -> None:
    """Entry point of `grasp-view`."""
    options = parse(Options, "grasp-view")
    console = Console(quiet=options.quiet)
    run(lambda: view_command(options, console), console)
