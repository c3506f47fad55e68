"""`grasp-verify`: is what a grasp file claims true?"""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Annotated

import tyro

from planner.terminal.command_line import ExitCode, Given, parse, run, write_json
from planner.terminal.console import Console

MARKS = {"holds": "ok", "fails": "FAIL", "not checked": "?"}
"""How each result of a check is shown."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """Re-check a grasp file with none of the code that searched for it.

    About the object: its files are those that were planned on, and mass and centre of mass are theirs; the task is made
    again from its preset or file and compared; every candidate lies on the surface, with normal and friction, every
    contact on its geom; the candidates are chosen again and compared, so that none was left out or added. About the
    grasp: the contacts are candidates and keep the limits; the forces balance every wrench, within cones and caps;
    another solver finds the same rho; the cuts prove the bound for every subset; the status says no more than that.

    A claim that cannot be checked (an absent file, a task or limits made in Python) gets a line with "?" that says why.
    It is no failure: the exit code is 0 where no claim is false, 5 where one is.
    """

    file: tyro.conf.Positional[Path]
    """A *.grasp.json."""

    object: Given[Path] = None
    """Where the object's file is now, if it has moved."""

    json: bool = False
    """Print one JSON document with the outcome to standard output; words then go to standard error. Its "checks" list
    each claim with its result: holds, fails, or not checked."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors (and what --json asks for)."""


def verify_command(options: Options, console: Console) -> ExitCode:
    """Check every claim and print how each came out."""
    console.show("loading CVXPY")
    from planner.grasps.grasp_file import read_grasp  # here: the help must not wait for CVXPY
    from planner.verification.verify import verify

    began = perf_counter()
    checks = verify(read_grasp(options.file), console.count, options.object)
    true = not any(check.fails for check in checks)
    for check in checks:
        console.say(f"{MARKS[check.result]:<4}  {check.claim} ({check.detail})")
    if options.json:
        known = {"true": true, "complete": all(check.holds for check in checks), "checks": checks}
        write_json(console, known | {"grasp": str(options.file), "seconds": perf_counter() - began})
    return ExitCode.DONE if true else ExitCode.FAILED


def main() -> None:
    """Entry point of `grasp-verify`."""
    options = parse(Options, "grasp-verify")
    console = Console(quiet=options.quiet, json=options.json)
    run(lambda: verify_command(options, console), console)
