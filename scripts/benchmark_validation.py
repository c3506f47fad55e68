"""What a validation costs, measured in one run: a table, a plot and a CSV file in a folder.

python scripts/benchmark_validation.py --out benchmark            # some minutes on two cores
python scripts/benchmark_validation.py --out benchmark --quick    # seconds, on few sizes
"""

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated

import tyro

from planner.terminal.command_line import ExitCode, parse, run
from planner.terminal.console import Console

WRENCHES, FINGERS = (16, 64, 256, 1024, 4096), (3, 4, 5, 6, 7, 8)
QUICK_WRENCHES, QUICK_FINGERS = (8, 16), (3, 4)
BISECTED = 64
"""Up to so many wrenches the full measurement is timed too."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """Time the stages of a validation for growing numbers of wrenches and fingers."""

    out: Path = Path("benchmark")
    """Folder for `costs.csv` and `costs.png`; made if missing."""

    quick: bool = False
    """Few and small sizes."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


def benchmark(options: Options, console: Console) -> ExitCode:
    """Measure, print, write."""
    console.show("loading MuJoCo and Matplotlib")
    from planner.files.atomic_write import write_atomically  # here: the help must not wait for MuJoCo
    from planner.pictures.figures import new_figure
    from sim.studies.cost import measure_cost
    from sim.studies.plots import plot_cost
    from sim.studies.tables import make_folder, to_csv
    from sim.validation.critical_force import expected_simulations

    make_folder(options.out)
    new_figure(1, 1)  # without Matplotlib, say so before the work and not after
    sizes = QUICK_WRENCHES if options.quick else WRENCHES
    fingers = QUICK_FINGERS if options.quick else FINGERS
    middle = sizes[-1] if options.quick else 64
    runs = [(fingers[0], sizes[0])]  # pays for imports and caches
    runs += [(4, size) for size in sizes] + [(count, middle) for count in fingers]
    work = [size + (expected_simulations(size) if size <= BISECTED else 0) for _, size in runs]
    console.say(
        f"{'fingers':>8} {'wrenches':>9} {'set up':>8} {'forces':>8} {'stepping':>9} {'measure':>8} {'ratio':>7}"
    )

    costs = []
    for number, (count, wrenches) in enumerate(runs):
        console.count(f"simulations ({count} fingers, {wrenches} wrenches)", sum(work[:number]), sum(work))
        cost = measure_cost(count, wrenches, bisect=wrenches <= BISECTED)
        console.say(
            f"{cost.fingers:8d} {cost.wrenches:9d} {cost.set_up:7.3f}s {cost.forces:7.3f}s {cost.stepping:8.3f}s "
            f"{cost.measuring:7.2f}s {cost.ratio:7.4f}"
        )
        costs.append(cost)
    by_wrenches, by_fingers = costs[1 : 1 + len(sizes)], costs[1 + len(sizes) :]
    write_atomically(options.out / "costs.csv", to_csv([asdict(cost) for cost in by_wrenches + by_fingers]))
    plot_cost(options.out / "costs.png", by_wrenches, by_fingers)
    console.say(f"wrote {options.out / 'costs.csv'} and costs.png")
    return ExitCode.DONE


def main() -> None:
    """Entry point."""
    options = parse(Options, "benchmark_validation")
    console = Console(quiet=options.quiet)
    run(lambda: benchmark(options, console), console)


if __name__ == "__main__":
    main()
