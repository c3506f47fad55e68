"""`grasp-validate`: is a grasp file true in MuJoCo?"""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Annotated, Literal

import tyro

from planner.terminal.command_line import ExitCode, Given, parse, run, write_json
from planner.terminal.console import Console


@dataclass(frozen=True, kw_only=True)
class Options:
    """Put fingertips on the planned contacts in MuJoCo, push with every wrench of the task, and see what slips.

    The verdict is pass when every wrench is held with the finger force capped at 1.02 rho, fail when one is not. It is
    "not trustworthy" when a control did not behave: the critical wrench must slip at 0.98 rho, less friction and
    another contact must change the outcome as predicted, and nothing may creep without load (under half of the critical
    wrench, where the fingers only support and cannot squeeze). It is "not trustworthy" too when a wrench that slipped
    lies on the friction limit, where no cap gives a margin.

    A grasp that does not belong to its object is refused before anything is simulated: mass, task and candidates are
    made again from the object as grasp-verify does, and compared; what of that cannot be checked is said. Whether the
    bound is proven is not asked here.
    """

    file: tyro.conf.Positional[Path]
    """A *.grasp.json."""

    out: Given[Path] = None
    """The result to write; by default NAME.validation.json in the current folder (.squeeze.json and .bench.json in the
    other modes)."""

    object: Given[Path] = None
    """Where the object's file is now, if it has moved."""

    mode: Literal["active", "squeeze", "dexgraspbench", "graspdatagen"] = "active"
    """What is tested: "active" fingers adapt their forces to each wrench, which is what rho means; "squeeze" measures
    what a constant squeeze would need instead; "dexgraspbench" and "graspdatagen" apply these benches' own tugs and
    thresholds, with fingertips."""

    squeeze: Given[float] = None
    """Force with which the fingertips squeeze in the two benches [N]; rho by default."""

    strict: bool = False
    """Hold at 1.005 rho and slip at 0.995 rho instead of 1.02 and 0.98."""

    measure: bool = False
    """Measure rho too: bisect the force cap of every wrench and compare it with the prediction."""

    thorough: bool = False
    """Measure, and load the grasp with random wrenches inside, on and outside W_R and with turning loads."""

    json: bool = False
    """Print one JSON document with the outcome to standard output; words then go to standard error."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors (and what --json asks for)."""


def validate_command(options: Options, console: Console) -> ExitCode:
    """Validate, write the result, and say what came out."""
    console.show("loading MuJoCo and dm_control")
    from planner.errors import GraspFileError
    from planner.files.atomic_write import require_writable  # here: the help must not wait for MuJoCo
    from planner.grasps.grasp_file import SUFFIX, read_grasp
    from planner.grasps.grasped_object import read_grasped_object
    from planner.grasps.lift import in_space
    from planner.verification.provenance.provenance import require_provenance
    from sim.commands.modes import MODES

    ending, test = MODES[options.mode]
    out = options.out or Path(options.file.name.removesuffix(SUFFIX) + ending)
    require_writable(out)
    grasp = read_grasp(options.file)
    if not grasp.found:
        raise GraspFileError(f"{options.file} holds no grasp (status {grasp.status}): there is nothing to validate")
    rigid_object = read_grasped_object(grasp, options.object)
    console.show("comparing the grasp with its object")
    for check in require_provenance(grasp, rigid_object):
        if not check.holds:
            console.say(f"unchecked   {check.claim} ({check.detail})")
    rigid_object, grasp = in_space(rigid_object, grasp)
    console.show("building the scene")
    began = perf_counter()
    outcome = test(rigid_object, grasp, options, console.count)
    outcome.write(out)
    console.say("\n".join([*outcome.lines, f"wrote       {out}"]))
    if options.json:
        known = {"mode": options.mode, "passed": outcome.passed}
        files = {"grasp": str(options.file), "file": str(out), "seconds": perf_counter() - began}
        write_json(console, known | outcome.summary | files)
    return ExitCode.DONE if outcome.passed else ExitCode.FAILED


def main() -> None:
    """Entry point of `grasp-validate`."""
    options = parse(Options, "grasp-validate")
    console = Console(quiet=options.quiet, json=options.json)
    run(lambda: validate_command(options, console), console)
