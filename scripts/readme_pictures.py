"""The README's picture of a report: plans and validates the mug, and photographs its page in headless Chromium.

    python scripts/readme_pictures.py --out assets/figures

The other pictures of the README come from reproduce_paper.py and measure_all.py.
"""

import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from planner.errors import OutputError
from planner.terminal.command_line import ExitCode, parse, run
from planner.terminal.console import Console

MUG = Path(__file__).resolve().parents[1] / "assets" / "mug" / "mug.xml"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
HEADLESS = (
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--virtual-time-budget=4000",
    "--window-size=1280,860",
)
"""No display, no network, WebGL on the processor."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """Film a grasp of the mug in MuJoCo and photograph its report, as the README shows them."""

    out: Path = Path("figures")
    """Folder for held.gif and report.png; made if missing."""


def photograph(options: Options) -> ExitCode:
    """Plan, validate, film, report, photograph."""
    from planner.commands import plan  # here: the help must not wait for MuJoCo
    from sim.commands import render, report, validate

    browser = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if browser is None:
        raise OutputError(f"no browser to photograph the page with; install one of {', '.join(BROWSERS)}")
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        grasp, page = Path(folder, "mug.grasp.json"), Path(folder, "mug.report.html")
        checked = Path(folder, "mug.validation.json")
        console = Console(quiet=True)
        plan.plan_command(
            plan.Options(object=MUG, friction=0.5, out=grasp), console, "grasp-plan mug.xml --friction 0.5"
        )
        validate.validate_command(validate.Options(file=grasp, out=checked), console)
        render.render_command(render.Options(file=grasp, out=(options.out / "held.gif",)), console)
        report.report_command(report.Options(files=(grasp,), out=page))
        picture = (options.out / "report.png").resolve()
        command = [browser, *HEADLESS, f"--user-data-dir={folder}/profile", f"--screenshot={picture}", page.as_uri()]
        subprocess.run(command, check=True, capture_output=True, timeout=120)
    print(f"wrote       {options.out / 'held.gif'} and {options.out / 'report.png'}")
    return ExitCode.DONE


if __name__ == "__main__":
    run(lambda: photograph(parse(Options, "readme_pictures.py")))
