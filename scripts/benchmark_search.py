"""How fast the certified search is, and what else one could do: tables and a figure, measured in one run.

    python scripts/benchmark_search.py --out benchmark            # some 20 minutes on two cores, best left alone
    python scripts/benchmark_search.py --out benchmark --quick    # seconds, on tiny instances

Competitors, on the same instances in the same run: enumeration on all cores, the paper's branch and bound, a
mixed-integer program with lazily added cuts by HiGHS, one with cones by SCIP where pyscipopt is installed, and, with
the time of the proof, simulated annealing and random restarts.
"""

import logging
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.terminal.command_line import ExitCode, parse, run
from scripts.search_benchmark.budgets import Budgets

if TYPE_CHECKING:
    from scripts.search_benchmark.instances import Benchmark
    from scripts.search_benchmark.measured import Measured


@dataclass(frozen=True, kw_only=True)
class Options(Budgets):
    """Time the certified search and its competitors on growing instances, in one run on one machine."""

    out: Path = Path("benchmark")
    """Folder for `search.md` and `search.png`; made if missing."""

    only: tuple[str, ...] = ()
    """Measure only instances whose name contains one of these."""

    quick: bool = False
    """Tiny instances and small budgets."""


def benchmark(options: Options) -> ExitCode:
    """Measure, print, write; the table is written anew after every instance, so that a stopped run leaves its part."""
    from planner.errors import ObjectError, SettingError
    from planner.files.atomic_write import write_atomically  # here: the help must not wait for the solvers
    from planner.pictures.figures import new_figure
    from scripts.search_benchmark.instances import FULL, QUICK
    from scripts.search_benchmark.machine import describe_machine
    from scripts.search_benchmark.measured import measure
    from scripts.search_benchmark.tables import document
    from sim.studies.tables import make_folder

    logging.getLogger("scripts.search_benchmark").setLevel(logging.INFO)
    make_folder(options.out)
    new_figure(1, 1)  # without Matplotlib, say so before the work and not after
    machine = describe_machine()
    chosen, budgets = (QUICK, options.small()) if options.quick else (FULL, options)
    in_tables = {instance.name for instance in chosen.tables}
    names = [instance.name for instance in chosen.instances]
    instances = [each for each in chosen.instances if any(part in each.name for part in options.only or ("",))]
    if not instances:
        raise SettingError(f"no instance is called like {', '.join(options.only)}; there are: {'; '.join(names)}")
    measured: dict[str, Measured] = {}
    skipped: list[str] = []
    for instance in instances:
        try:
            measured[instance.name] = measure(instance, budgets, in_tables=instance.name in in_tables)
        except ObjectError as error:
            skipped.append(f"{instance.name}: {error}.")
        text = document(list(measured.values()), skipped, machine)
        write_atomically(options.out / "search.md", text.encode())
        _plot(options.out / "search.png", chosen, measured)
    print(text)
    print(f"wrote {options.out / 'search.md'} and search.png", file=sys.stderr)
    return ExitCode.FAILED if any(any(each.disagreements()) for each in measured.values()) else ExitCode.DONE


def _plot(path: Path, chosen: "Benchmark", measured: "dict[str, Measured]") -> None:
    """The curves of what has been measured so far."""
    from scripts.search_benchmark.plots import plot_growth

    curves = [
        [measured[each.name] for each in series if each.name in measured]
        for series in (chosen.by_candidates, chosen.by_fingers)
    ]
    plot_growth(path, *curves)


def main() -> None:
    """Entry point."""
    options = parse(Options, "benchmark_search")
    run(lambda: benchmark(options))


if __name__ == "__main__":
    main()
