"""Is the instrument right? Three tables of evidence and a plot, measured in one run and saved in a folder.

    python scripts/measure_all.py --out measured            # about three quarters of an hour on two cores
    python scripts/measure_all.py --out measured --quick    # under a minute, on little of it

1. Every asset, 3 to 5 fingers or 2 soft ones, friction 0.2 to 1.0: measured against predicted rho.
2. Random feasible grasps, with hard fingers and with soft ones, every wrench by itself at 0.98 to 1.02 of its own phi:
   false passes and false fails.
3. Wrong planners, on purpose, of three hard fingers and of two soft ones: what the measurement makes of them.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import tyro

from planner.terminal.command_line import ExitCode, parse, run
from planner.terminal.console import Console

if TYPE_CHECKING:
    from planner.objects.rigid_object import RigidObject
    from sim.validation.critical_force import CriticalForce

ASSETS = Path(__file__).resolve().parents[1] / "assets"
NAMES = ("box", "bracket", "cylinder", "ellipsoid", "mug", "prism")
FINGERS, FRICTIONS, GRASPS = (3, 4, 5), (0.2, 0.4, 0.6, 0.8, 1.0), 32
SOFT_FINGERS, PATCH = (2,), 0.004
"""Of soft fingers, the radius of the patch [m]."""
FACTORS = (0.98, 0.99, 0.995, 1.005, 1.01, 1.02)
FAULTY_FRICTION = 0.5
MEASURED, TESTED, FAULTY = "grasps (measured rho)", "grasps (wrong verdicts)", "grasps (wrong planners)"


@dataclass(frozen=True, kw_only=True)
class Options:
    """Measure rho over all assets, count wrong verdicts on random grasps, and inject faults into the planner."""

    out: Path = Path("measured")
    """Folder for the tables (CSV and Markdown) and the plot; made if missing."""

    seed: int = 0
    """Of candidates and random grasps."""

    quick: bool = False
    """Two assets, one of everything else."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


def measure_all(options: Options, console: Console) -> ExitCode:
    """Measure, print, write."""
    console.show("loading MuJoCo and Matplotlib")
    from planner.objects.mjcf.reader import read_object
    from planner.pictures.figures import new_figure  # here: the help must not wait for MuJoCo
    from sim.studies.tables import make_folder

    make_folder(options.out)
    new_figure(1, 1)  # without Matplotlib, say so before the work and not after
    names = NAMES[:2] if options.quick else NAMES
    objects = [read_object(ASSETS / name / f"{name}.xml") for name in names]
    _rho(objects, options, console)
    wrong = sum(_tally(objects, options, console, soft=soft) for soft in (False, True))
    _inject_faults(objects, options, console)
    console.say(f"wrote {options.out}")
    return ExitCode.FAILED if wrong else ExitCode.DONE


def _rho(objects: "Sequence[RigidObject]", options: Options, console: Console) -> None:
    """Table 1 and the plot."""
    from sim.studies.plots import plot_rho
    from sim.studies.rho_table import RhoRow, rho_rows
    from sim.studies.survey import Pad

    fingers, frictions = (FINGERS[:1], FRICTIONS[2:3]) if options.quick else (FINGERS, FRICTIONS)
    rows: list[RhoRow] = []
    total = len(objects) * (len(fingers) + len(SOFT_FINGERS)) * len(frictions)
    console.count(MEASURED, 0, total)
    points = [Pad(friction=friction) for friction in frictions]
    pads = [Pad(friction=friction, patch=PATCH) for friction in frictions]
    hard, soft = (rho_rows(objects, *each, seed=options.seed) for each in ((fingers, points), (SOFT_FINGERS, pads)))
    for row in chain(hard, soft):
        rows.append(row)
        outcome = row.note or f"rho {row.predicted:.5g} N, measured / predicted {row.ratio:.4f}"
        kind = "soft fingers" if row.patch else "fingers"
        console.say(f"{row.object:12} {row.fingers} {kind}, friction {row.friction:.1f}: {outcome}")
        console.count(MEASURED, len(rows), total)
    ratios = [row.ratio for row in rows if not row.note]
    if ratios:
        console.say(f"{len(ratios)} grasps: measured / predicted from {min(ratios):.4f} to {max(ratios):.4f}")
    _save(options.out / "rho", [asdict(row) | {"ratio": row.ratio} for row in rows])
    plot_rho(options.out / "rho.png", rows)


def _tally(objects: "Sequence[RigidObject]", options: Options, console: Console, *, soft: bool) -> int:
    """Table 2; returns the number of wrong verdicts."""
    from sim.studies.survey import random_grasps, tally

    kind = "soft" if soft else "hard"
    console.show(f"drawing random grasps of {kind} fingers")
    grasps = random_grasps(objects, 2 if options.quick else GRASPS, options.seed, soft=soft)
    tallies = tally(grasps, FACTORS, observe=lambda done: console.count(TESTED, done, len(grasps)))
    for each in tallies:
        wrongs = "false passes" if each.factor < 1 else "false fails"
        console.say(
            f"{kind} fingers, cap {each.factor:g} phi: {each.wrong} {wrongs} in {each.tests} single-wrench tests; "
            f"on the friction limit {each.limited_wrong} in {each.limited}"
        )
    _save(options.out / f"tally_{kind}", [asdict(each) for each in tallies])
    return sum(each.wrong for each in tallies)


def _inject_faults(objects: "Sequence[RigidObject]", options: Options, console: Console) -> None:
    """Table 3."""
    from sim.studies.fault_injection import INJECTED_FAULTS, SOFT_FAULTS, measure_fault
    from sim.studies.survey import Pad, planned_grasp

    rows: list[dict[str, object]] = []
    tried = objects[:1] if options.quick else objects
    total = len(tried) * (len(INJECTED_FAULTS) + len(SOFT_FAULTS))
    console.count(FAULTY, 0, total)
    for rigid_object in tried:
        hard, soft = Pad(friction=FAULTY_FRICTION), Pad(friction=FAULTY_FRICTION, patch=PATCH)
        points = planned_grasp(rigid_object, FINGERS[0], hard, options.seed)
        pinch = planned_grasp(rigid_object, SOFT_FINGERS[0], soft, options.seed)
        for grasp, fault in [(points, fault) for fault in INJECTED_FAULTS] + [(pinch, fault) for fault in SOFT_FAULTS]:
            critical = measure_fault(grasp, fault)
            ratio = critical.ratio if critical else float("nan")
            outcome = _noticed(critical)
            fingers = len(grasp.contacts)
            console.say(f"{rigid_object.file.stem:12} {fingers} fingers, {fault.name:46} {outcome}")
            rows.append({"object": rigid_object.file.stem, "fingers": fingers, "fault": fault.name, "ratio": ratio})
            console.count(FAULTY, len(rows), total)
    _save(options.out / "fault_injection", rows)


def _noticed(critical: "CriticalForce | None") -> str:
    """What is seen of a wrong planner, in words."""
    if critical is None:
        return "it finds no grasp"
    return "no cap holds" if critical.ratio == float("inf") else f"{critical.ratio - 1:+.1%}"


def _save(stem: Path, rows: list[dict[str, object]]) -> None:
    """One table as CSV and as Markdown."""
    from planner.files.atomic_write import write_atomically
    from sim.studies.tables import to_csv, to_markdown

    write_atomically(stem.with_suffix(".csv"), to_csv(rows))
    write_atomically(stem.with_suffix(".md"), to_markdown(rows).encode())


def main() -> None:
    """Entry point."""
    options = parse(Options, "measure_all")
    console = Console(quiet=options.quiet)
    run(lambda: measure_all(options, console), console)


if __name__ == "__main__":
    main()
