"""`grasp-verify`: is what a grasp file claims true?"""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Annotated

import tyro

from planner.commands.console import Console
from planner.commands.terminal import ExitCode, parse, run, write_json


@dataclass(frozen=True, kw_only=True)
class Options:
    """Re-check a grasp file with none of the code that found it: forces, rho by another solver, and the bound."""

    file: tyro.conf.Positional[Path]
    """A *.grasp.json."""

    json: bool = False
    """Print one JSON document with the outcome to standard output; words then go to standard error."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors (and what --json asks for)."""


def verify_command(options: Options, console: Console) -> ExitCode:
    """Check every claim and print how each came out."""
    console.show("loading CVXPY")
    from planner.grasp_file import read_grasp  # here: the help must not wait for CVXPY
    from planner.verification import verify

    began = perf_counter()
    checks = verify(read_grasp(options.file), console.count)
    true = all(check.holds for check in checks)
    for check in checks:
        console.say(f"{'ok  ' if check.holds else 'FAIL'}  {check.claim} ({check.detail})")
    if options.json:
        seconds = perf_counter() - began
        write_json(console, {"true": true, "checks": checks, "grasp": str(options.file), "seconds": seconds})
    return ExitCode.DONE if true else ExitCode.FAILED


def main() -> None:
    """Entry point of `grasp-verify`."""
    options = parse(Options, "grasp-verify")
    console = Console(quiet=options.quiet, json=options.json)
    run(lambda: verify_command(options, console), console)
