"""How the cost grows, drawn by Matplotlib (an extra, imported when the figure is drawn)."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from planner.pictures.figures import new_figure, save_figure
from scripts.search_benchmark.measured import Measured

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CERTIFIED = "#c0392b"
OTHERS = ("#4a5568", "#2b6cb0", "#b7791f", "#2f855a")
"""Colours."""


def plot_growth(path: Path, by_candidates: Sequence[Measured], by_fingers: Sequence[Measured]) -> None:
    """Seconds to the proof against n and against m; a hollow triangle is a lower bound.

    Args:
        path: The PNG to write.
        by_candidates: One object, one number of fingers.
        by_fingers: One object, one number of candidates.

    Raises:
        OutputError: When Matplotlib is not installed or the file cannot be written.
    """
    figure = new_figure(10.0, 4.6)
    left, right = figure.subplots(1, 2, sharey=True)
    _draw(left, by_candidates, lambda each: each.candidates)
    _draw(right, by_fingers, lambda each: each.fingers)
    left.set(xscale="log", xlabel="candidates n", ylabel="seconds to the proof")
    right.set(xlabel="fingers m")
    right.xaxis.get_major_locator().set_params(integer=True)
    if by_candidates:
        left.set_title(f"Case III prism, m = {by_candidates[0].fingers}")
    if by_fingers:
        right.set_title(f"Case III prism, n = {by_fingers[0].candidates}")
        right.legend(fontsize=8, title="hollow triangles: at least", title_fontsize=8)
    save_figure(path, figure)


def _draw(axes: "Axes", measured: Sequence[Measured], place: Callable[[Measured], int]) -> None:
    """One curve per method."""
    axes.set_yscale("log")
    places = [place(each) for each in measured]
    axes.plot(
        places, [each.certified.run.seconds for each in measured], "o-", color=CERTIFIED, label="certified search"
    )
    names = list(measured[0].outcomes) if measured else []
    for name, color in zip(names, OTHERS, strict=False):
        outcomes = [each.outcomes[name] for each in measured]
        axes.plot(places, [outcome.seconds for outcome in outcomes], "-", color=color, linewidth=0.8, alpha=0.5)
        done = [(x, outcome.seconds) for x, outcome in zip(places, outcomes, strict=True) if outcome.finished]
        open_ = [(x, outcome.seconds) for x, outcome in zip(places, outcomes, strict=True) if not outcome.finished]
        axes.plot([x for x, _ in done], [y for _, y in done], "o", color=color, label=name)
        axes.plot([x for x, _ in open_], [y for _, y in open_], "^", color=color, markerfacecolor="white")
