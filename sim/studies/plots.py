"""Figures of measurements, drawn by Matplotlib (an extra, imported when the first figure is drawn)."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from planner.pictures.figures import new_figure, save_figure
from sim.studies.cost import Cost
from sim.studies.rho_table import RhoRow

BAND = 0.005
"""Half width of the band that measured ratios are to lie in."""


def plot_rho(path: Path, rows: Sequence[RhoRow]) -> None:
    """Measured against predicted rho on logarithmic axes, and their ratio in its band.

    Args:
        path: The PNG to write.
        rows: Of which those without a measurement are left out.

    Raises:
        OutputError: When Matplotlib is not installed or the file cannot be written.
    """
    measured = [row for row in rows if not row.note]
    figure = new_figure(6.4, 7.2)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    for name in sorted({row.object for row in measured}):
        chosen = [row for row in measured if row.object == name]
        predicted = np.array([row.predicted for row in chosen])
        ratios = np.array([row.ratio for row in chosen])
        above.loglog(predicted, ratios * predicted, "o", label=name, markersize=5, alpha=0.7)
        below.semilogx(predicted, ratios, "o", markersize=5, alpha=0.7)
    if measured:
        ends = np.array([min(row.predicted for row in measured) / 1.3, max(row.predicted for row in measured) * 1.3])
        above.loglog(ends, ends, color="black", linewidth=0.8, zorder=0)
        for axes, center in ((above, ends), (below, np.ones(2))):
            axes.fill_between(ends, (1 - BAND) * center, (1 + BAND) * center, color="0.85", zorder=-1)
        above.legend(title=f"band: ±{BAND:.1%}", fontsize=8)
    above.set_ylabel("measured rho [N]")
    below.set_ylabel("measured / predicted")
    below.set_xlabel("predicted rho [N]")
    below.set_ylim(1 - 2 * BAND, 1 + 2 * BAND)
    save_figure(path, figure)


def plot_cost(path: Path, by_wrenches: Sequence[Cost], by_fingers: Sequence[Cost]) -> None:
    """Seconds of a verdict against the number of wrenches and of fingers.

    Args:
        path: The PNG to write.
        by_wrenches: Costs with the same number of fingers.
        by_fingers: Costs with the same number of wrenches.

    Raises:
        OutputError: When Matplotlib is not installed or the file cannot be written.
    """
    figure = new_figure(9.0, 4.0)
    left, right = figure.subplots(1, 2)
    for axes, costs, key in ((left, by_wrenches, "wrenches"), (right, by_fingers, "fingers")):
        places = [getattr(cost, key) for cost in costs]
        for stage in ("stepping", "forces", "set_up"):
            axes.plot(places, [getattr(cost, stage) for cost in costs], "o-", label=stage.replace("_", " "))
        axes.set_xlabel(f"number of {key}")
        axes.set_yscale("log")
    left.set_xscale("log")
    left.set_ylabel("seconds for a verdict")
    left.set_title(f"{by_wrenches[0].fingers} fingers")
    right.set_title(f"{by_fingers[0].wrenches} wrenches")
    right.legend()
    save_figure(path, figure)
