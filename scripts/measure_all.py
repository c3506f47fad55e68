"""Is the instrument right? Three tables of evidence and a plot, measured in one run and saved in a folder.

    python scripts/measure_all.py --out measured            # about half an hour on two cores
    python scripts/measure_all.py --out measured --quick    # under a minute, on little of it

1. Every asset, 3 to 5 fingers, friction 0.2 to 1.0: measured against predicted rho.
2. Random feasible grasps, every wrench by itself at 0.99 and 1.01 of its own phi: false passes and false fails.
3. Wrong planners, on purpose: what the measurement makes of them.
"""

import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.commands.terminal import ExitCode, parse, run

if TYPE_CHECKING:
    from planner.objects.rigid_object import RigidObject

ASSETS = Path(__file__).resolve().parents[1] / "assets"
NAMES = ("box", "bracket", "cylinder", "ellipsoid", "mug", "prism")
FINGERS, FRICTIONS, GRASPS = (3, 4, 5), (0.2, 0.4, 0.6, 0.8, 1.0), 32
FACTORS = (0.99, 1.01)
SABOTAGED_FRICTION = 0.5


@dataclass(frozen=True, kw_only=True)
class Options:
    """Measure rho over all assets, count wrong verdicts on random grasps, and sabotage the planner."""

    out: Path = Path("measured")
    """Folder for the tables (CSV and Markdown) and the plot; made if missing."""

    seed: int = 0
    """Of candidates and random grasps."""

    quick: bool = False
    """Two assets, one of everything else."""


def measure_all(options: Options) -> ExitCode:
    """Measure, print, write."""
    from planner.exports.figures import new_figure  # here: the help must not wait for MuJoCo
    from planner.objects.mjcf import read_object
    from sim.tables import make_folder

    make_folder(options.out)
    new_figure(1, 1)  # without Matplotlib, say so before the work and not after
    names = NAMES[:2] if options.quick else NAMES
    objects = [read_object(ASSETS / name / f"{name}.xml") for name in names]
    _rho(objects, options)
    wrong = _tally(objects, options)
    _sabotage(objects, options)
    print(f"wrote {options.out}", file=sys.stderr)
    return ExitCode.FAILED if wrong else ExitCode.DONE


def _rho(objects: "Sequence[RigidObject]", options: Options) -> None:
    """Table 1 and the plot."""
    from sim.plots import plot_rho
    from sim.rho_table import rho_rows

    fingers, frictions = (FINGERS[:1], FRICTIONS[2:3]) if options.quick else (FINGERS, FRICTIONS)
    rows = []
    for row in rho_rows(objects, fingers, frictions, seed=options.seed):
        rows.append(row)
        outcome = row.note or f"rho {row.predicted:.5g} N, measured / predicted {row.ratio:.4f}"
        print(f"{row.object:12} {row.fingers} fingers, friction {row.friction:.1f}: {outcome}", flush=True)
    ratios = [row.ratio for row in rows if not row.note]
    if ratios:
        print(f"{len(ratios)} grasps: measured / predicted from {min(ratios):.4f} to {max(ratios):.4f}")
    _save(options.out / "rho", [asdict(row) | {"ratio": row.ratio} for row in rows])
    plot_rho(options.out / "rho.png", rows)


def _tally(objects: "Sequence[RigidObject]", options: Options) -> int:
    """Table 2; returns the number of wrong verdicts."""
    from sim.survey import random_grasps, tally

    grasps = random_grasps(objects, 2 if options.quick else GRASPS, options.seed)
    tallies = tally(grasps, FACTORS, observe=lambda done: print(f"{done} of {len(grasps)} grasps", file=sys.stderr))
    for each in tallies:
        kind = "false passes" if each.factor < 1 else "false fails"
        print(f"cap {each.factor:g} phi: {each.wrong} {kind} in {each.tests} single-wrench tests")
    _save(options.out / "tally", [asdict(each) for each in tallies])
    return sum(each.wrong for each in tallies)


def _sabotage(objects: "Sequence[RigidObject]", options: Options) -> None:
    """Table 3."""
    from sim.sabotage import SABOTAGES, measure_sabotage
    from sim.survey import planned_grasp

    rows = []
    for rigid_object in objects[:1] if options.quick else objects:
        grasp = planned_grasp(rigid_object, FINGERS[0], SABOTAGED_FRICTION, options.seed)
        for sabotage in SABOTAGES:
            critical = measure_sabotage(grasp, sabotage)
            ratio = critical.ratio if critical else float("nan")
            outcome = "no cap holds" if ratio == float("inf") else f"{ratio - 1:+.1%}"
            print(f"{rigid_object.file.stem:12} {sabotage.name:32} {outcome}", flush=True)
            rows.append({"object": rigid_object.file.stem, "sabotage": sabotage.name, "ratio": ratio})
    _save(options.out / "sabotage", rows)


def _save(stem: Path, rows: list[dict[str, object]]) -> None:
    """One table as CSV and as Markdown."""
    from planner.atomic_write import write_atomically
    from sim.tables import to_csv, to_markdown

    write_atomically(stem.with_suffix(".csv"), to_csv(rows))
    write_atomically(stem.with_suffix(".md"), to_markdown(rows).encode())


def main() -> None:
    """Entry point."""
    options = parse(Options, "measure_all")
    run(lambda: measure_all(options))


if __name__ == "__main__":
    main()
