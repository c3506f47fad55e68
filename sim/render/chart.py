"""The measurement itself: slip over time on a logarithmic scale, with the line that a held fingertip stays under.

Soft fingertips spin too: theirs is drawn where it is more, in the unit in which a hold allows as much of both.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from sim.render.palette import INK, LINE, MUTED, SLIPPED
from sim.render.sheet import Sheet
from sim.scene.units import WHAT_R0_IS
from sim.trial.protocol import ValidationProtocol

TICKS = (1e-8, 1e-6, 1e-4, 1e-2, 1.0)
"""Slips beside the chart, relative to R0; what is beyond the outer ones is drawn on them."""
SMALL = 10.0
"""Size of the letters [points]."""
DASH = 4.0
"""Of the line that divides what is held from what slipped [points]."""


@dataclass(frozen=True, kw_only=True)
class Chart:
    """A chart and where it is [points]."""

    left: float
    top: float
    right: float
    bottom: float
    protocol: ValidationProtocol

    soft: bool
    """Whether some fingertips have torsional friction."""

    def draw(self, sheet: Sheet, times: Floats, gone: Sequence[Floats], colors: Sequence[str], step: int) -> None:
        """Draw axes, and curves up to one step.

        Args:
            sheet: Where to draw.
            times: Of every step, shape (steps,) [s].
            gone: Of every simulation, see `Measurement.gone`, each of shape (steps,); the first is drawn on top.
            colors: Of every simulation's curve.
            step: The last that is known.
        """
        self._slip_axis(sheet)
        self._time_axis(sheet)
        for values, color in reversed(list(zip(gone, colors, strict=True))):
            known = zip(times[: step + 1], values[: step + 1], strict=True)
            points = [(self._column(time), self._row(slip)) for time, slip in known]
            if len(points) > 1:
                sheet.line(points, 1.6, color)
            sheet.dot(*points[-1], 3.2, color)

    def _slip_axis(self, sheet: Sheet) -> None:
        for tick in TICKS:
            row = self._row(tick)
            sheet.line([(self.left, row), (self.right, row)], 0.5, LINE)
            sheet.text(self.left - 6, row, f"{tick:g}", SMALL, MUTED, "rm")
        allowed = self.protocol.slip_tolerance
        row = self._row(allowed)
        for column in np.arange(self.left, self.right, 2 * DASH).tolist():
            sheet.line([(column, row), (min(column + DASH, self.right), row)], 1.0, SLIPPED)
        sheet.text(self.left + 6, row - 7, f"slipped: above {allowed:g}", SMALL, SLIPPED)
        spin = f", or spin / {self.protocol.spin_of_reach:g} rad" if self.soft else ""
        sheet.text(self.left, self.top - 11, f"largest slip of a fingertip / R0, {WHAT_R0_IS}{spin}", SMALL, INK)

    def _time_axis(self, sheet: Sheet) -> None:
        protocol = self.protocol
        grown = protocol.preload_time + protocol.ramp_time
        ends = (0.0, protocol.preload_time, grown, protocol.duration)
        for start, stop, words in zip(ends[:-1], ends[1:], ("press", "load grows", "hold"), strict=True):
            left, right = self._column(start), self._column(stop)
            sheet.line([(left, self.top), (left, self.bottom + 14)], 0.5, LINE)
            sheet.text((left + right) / 2, self.bottom + 9, words, SMALL, MUTED, "mm")

    def _column(self, time: float) -> float:
        return self.left + (self.right - self.left) * time / self.protocol.duration

    def _row(self, slip: float) -> float:
        lowest, highest = TICKS[0], TICKS[-1]
        share = np.log(np.clip(slip, lowest, highest) / lowest) / np.log(highest / lowest)
        return float(self.bottom - (self.bottom - self.top) * share)
