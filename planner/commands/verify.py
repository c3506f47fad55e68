"""`grasp-verify`: is what a grasp file claims true?"""

from dataclasses import dataclass
from pathlib import Path

import tyro

from planner.commands.terminal import ExitCode, parse, run


@dataclass(frozen=True, kw_only=True)
class Options:
    """Re-check a grasp file with none of the code that found it: forces, rho by another solver, and the bound."""

    file: tyro.conf.Positional[Path]
    """A *.grasp.json; its side file must be beside it."""


def verify_command(options: Options) -> ExitCode:
    """Check every claim and print how each came out."""
    from planner.grasp_file import read_grasp  # here: the help must not wait for CVXPY
    from planner.verification import verify

    checks = verify(read_grasp(options.file))
    for check in checks:
        print(f"{'ok  ' if check.holds else 'FAIL'}  {check.claim} ({check.detail})")
    return ExitCode.DONE if all(check.holds for check in checks) else ExitCode.FAILED


def main() -> None:
    """Entry point of `grasp-verify`."""
    options = parse(Options, "grasp-verify")
    run(lambda: verify_command(options))
