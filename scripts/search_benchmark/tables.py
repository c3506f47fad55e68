"""The measurements as Markdown."""

from collections.abc import Iterator, Sequence

import numpy as np

from planner.search.result import Status, relative_gap
from scripts.search_benchmark.competitors.outcome import Outcome
from scripts.search_benchmark.instances import USUAL_GAP
from scripts.search_benchmark.measured import Measured

MEMORY_TARGET = 1e9
"""[bytes]"""


def document(measured: Sequence[Measured], skipped: Sequence[str], machine: str) -> str:
    """All tables under their captions, with what was skipped and why."""
    lines = ["# The certified search, timed\n", f"One run on one machine: {machine}.\n"]
    lines += [f"Skipped: {reason}\n" for reason in skipped]
    if measured:
        lines += [*certified_table(measured), *time_table(measured), *answer_table(measured)]
        lines += heuristic_table([each for each in measured if each.trials])
    lines += [f"DISAGREEMENT: {sentence}\n" for each in measured for sentence in each.disagreements()]
    return "\n".join(lines)


def certified_table(measured: Sequence[Measured]) -> Iterator[str]:
    """What the certified search and its verifier take."""
    yield "## The search and its proof\n"
    yield f"To a relative gap of {USUAL_GAP:g} where the name says no other.\n"
    yield from _head(
        *("instance", "candidates", "subsets", "rho [N]", "gap proven", "seconds: median (range, runs)"),
        *("first grasp [s]", "nodes", "SOCPs", "cuts kept", "verifier [s]", "peak memory [MB]", "target [s]"),
    )
    for each in measured:
        certified, run = each.certified, each.certified.run
        spread = f"{_number(certified.seconds[0])} to {_number(certified.seconds[-1])}, {len(certified.seconds)}"
        yield _row(
            *(each.instance.name, f"{each.candidates:,}", _number(each.subsets), f"{run.rho:.5g}"),
            _gap(run.rho, run.lower_bound),
            f"{_number(run.seconds)} ({spread})",
            *(_number(run.first_incumbent), f"{run.nodes:,}", f"{run.socp_solves:,}", f"{len(run.directions):,}"),
            *(_verdict(each), f"{certified.peak_memory / 1e6:.0f}", _target(each)),
        )
    peak = max(each.certified.peak_memory for each in measured)
    met = "met" if peak < MEMORY_TARGET else "not met"
    yield f"\nLargest peak memory {peak / 1e6:.0f} MB, Python included; target {MEMORY_TARGET / 1e6:.0f} MB: {met}.\n"


def time_table(measured: Sequence[Measured]) -> Iterator[str]:
    """Seconds to the same proof, and the ratio to the certified search."""
    names = list(measured[0].outcomes)
    yield "## Seconds to the same proof, and how many times those of the certified search\n"
    yield '">": at least; the budget was spent before the end.\n'
    yield from _head("instance", "certified", *names)
    for each in measured:
        seconds = each.certified.run.seconds
        yield _row(each.instance.name, _number(seconds), *(_time(each.outcomes[name], seconds) for name in names))
    yield ""


def answer_table(measured: Sequence[Measured]) -> Iterator[str]:
    """Best rho of each, and how far each has proven it."""
    names = list(measured[0].outcomes)
    yield "## rho found within the budget [N], and the gap proven\n"
    yield from _head("instance", "certified", *names)
    for each in measured:
        run = each.certified.run
        cells = [_answer(each.outcomes[name].rho, each.outcomes[name].lower_bound) for name in names]
        yield _row(each.instance.name, _answer(run.rho, run.lower_bound), *cells)
    yield ""


def heuristic_table(measured: Sequence[Measured]) -> Iterator[str]:
    """How often heuristics miss what is proven, given the same time."""
    names = list(measured[0].trials) if measured else []
    yield "## Heuristics with the time of the proof: seeds that miss rho by more than the gap\n"
    yield from _head("instance", "seconds each", *names)
    for each in measured:
        seconds = next(iter(each.trials.values())).seconds
        yield _row(each.instance.name, _number(seconds), *(_misses(each, name) for name in names))
    yield ""


def _misses(each: Measured, name: str) -> str:
    trials = each.trials[name]
    excess = trials.excess(each.certified.run.rho, each.instance.gap)
    text = f"{len(excess)} of {len(trials.rho)}"
    if not len(excess):
        return text
    middle, worst = (
        f"{part:.1%}" if np.isfinite(part) else "no grasp found" for part in (np.median(excess), excess[-1])
    )
    return f"{text}; median miss {middle}, worst {worst}"


def _time(outcome: Outcome, certified: float) -> str:
    ratio = f"×{_number(outcome.seconds / certified)}"
    if outcome.finished:
        return f"{_number(outcome.seconds)} ({ratio})"
    return f"> {_number(outcome.seconds)} (> {ratio}); {outcome.note}"


def _answer(rho: float, lower_bound: float) -> str:
    return f"{rho:.5f} ({_gap(rho, lower_bound)})" if np.isfinite(rho) else "–"


def _gap(rho: float, lower_bound: float) -> str:
    gap = relative_gap(rho, lower_bound)
    return f"{gap:.1e}" if np.isfinite(gap) else "unproven"


def _verdict(each: Measured) -> str:
    certified = each.certified
    if np.isnan(certified.verifier_seconds):
        return "–"
    if certified.proven is None:
        return f"> {_number(certified.verifier_seconds)}"
    return _number(certified.verifier_seconds) if certified.proven else "REFUTED"


def _target(each: Measured) -> str:
    target, run = each.instance.target, each.certified.run
    if target is None:
        return "–"
    met = run.status is Status.OPTIMAL and run.seconds <= target
    return f"{target:g}: {'met' if met else 'not met'}"


def _number(value: float) -> str:
    """Three digits; seconds of a second are as readable as those of a year."""
    return f"{value:,.0f}" if 1000 <= value < 1e6 else f"{value:.3g}"


def _head(*cells: str) -> Iterator[str]:
    yield _row(*cells)
    yield "|---" * len(cells) + "|"


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"
