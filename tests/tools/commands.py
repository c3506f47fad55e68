"""Run the project's commands as a user types them, in this process."""

import math
import re
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from planner.commands import convert, inspect, plan, verify
from sim.commands import render, report, validate, view

ROOT = Path(__file__).resolve().parents[2]
ASSETS = ROOT / "assets"
PRISM = ASSETS / "prism" / "prism.xml"

MAINS: dict[str, Callable[[], None]] = {
    "grasp-plan": plan.main,
    "grasp-verify": verify.main,
    "grasp-validate": validate.main,
    "grasp-convert": convert.main,
    "grasp-inspect": inspect.main,
    "grasp-report": report.main,
    "grasp-render": render.main,
    "grasp-view": view.main,
}


def run(command: str, *arguments: object) -> int:
    """Run a console command, without the lines that a slow machine adds about its progress; returns its exit code."""
    with pytest.MonkeyPatch.context() as patch, pytest.raises(SystemExit) as left:
        patch.setattr("planner.terminal.console.PATIENCE", math.inf)
        patch.setattr(sys, "argv", [command, *map(str, arguments)])
        MAINS[command]()
    return int(left.value.code or 0)


def heavy_after_help(script: str, *suspects: str) -> tuple[list[str], str]:
    """Which of the suspects a script's --help imports, and what it prints."""
    return heavy_after(script, ["--help"], *suspects)


def heavy_after(script: str, arguments: Sequence[object], *suspects: str) -> tuple[list[str], str]:
    """Which of the suspects a script imports when it is run like this, and what it prints."""
    code = (
        f"import os, sys, runpy; sys.argv = {['x', *map(str, arguments)]!r}; os._exit = sys.exit\n"
        f"try: runpy.run_path({str(ROOT / 'scripts' / f'{script}.py')!r}, run_name='__main__')\n"
        "except SystemExit: pass\n"
        f"print('HEAVY', *sorted({set(suspects)!r} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    printed, heavy = done.stdout.rsplit("HEAVY", 1)
    return heavy.split(), printed


def says(text: str, pattern: str) -> bool:
    """Whether a message, its line breaks aside, matches a pattern."""
    return re.search(pattern, " ".join(text.split())) is not None
