"""A whole picture: both simulations side by side, what is seen in words, and the measured slip below."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from PIL import Image

from planner.errors import SettingError
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.render.chart import Chart
from sim.render.friction_words import friction_words
from sim.render.palette import BACKGROUND, CONE, FORCE, HELD, INK, LINE, LOAD, MUTED, SLIPPED, rgb
from sim.render.panel import Label, Panel
from sim.render.recording import Recording, known_outcome
from sim.render.sheet import HIGH, Sheet

LEAST, MOST = (640, 360), (3840, 2160)
"""Sizes in which the words can be read, and that graphics cards draw [pixels]."""
NARROWEST = 4 / 3
"""Least width over height: two simulations stand side by side."""
HEADER, FOOTER = 92.0, 134.0
"""Heights above and below the simulations [points]."""
EDGE = 24.0
"""Of the picture, which is left free [points]."""
NOTES = 200.0
"""Width of the column of notes [points]."""
LONGEST_NAME = 20
"""Letters."""
FAINT = 0.35
"""Opacity of the number of a hidden contact."""


@dataclass(frozen=True, kw_only=True)
class Heading:
    """The words above a picture."""

    name: str
    details: str

    need: str
    """What the cap is compared with: rho, or phi of a wrench that is not the critical one."""


def heading_of(name: str, grasp: Grasp, recording: Recording) -> Heading:
    """The words above the pictures of a grasp."""
    critical = recording.wrench == grasp.critical_wrench
    details = [
        f"{len(grasp.contacts)} fingers",
        friction_words(grasp.contacts),
        f"{'critical wrench' if critical else 'wrench'} {recording.wrench} of {len(grasp.phi)}",
        f"rho = {grasp.rho:.4g} N",
        *([] if critical else [f"phi = {recording.need:.4g} N"]),
    ]
    short = name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"
    return Heading(name=short, details=" · ".join(details), need="rho" if critical else "phi")


class Picture:
    """Draws any instant of a recording. Close it, or use it in a `with` block."""

    def __init__(
        self,
        rigid_object: RigidObject,
        recording: Recording,
        heading: Heading,
        size: tuple[int, int],
        direction: tuple[float, float] | None = None,
    ) -> None:
        """
        Args:
            rigid_object: What is held, in the body frame, SI.
            recording: What happened.
            heading: The words above.
            size: Width and height [pixels].
            direction: Azimuth and elevation of the camera [degrees]; by default where the contacts are seen best.

        Raises:
            SettingError: When the size or the direction is out of range.
            RenderingError: When there is no OpenGL to draw with.
        """
        _check(size, direction)
        self.size, self.recording, self._heading = size, recording, heading
        self._soft = bool(recording.experiment.grasp.contacts.torsions.any())
        self._measured = [recording.measured(simulation) for simulation in range(len(recording.trial.caps))]
        width, height = size
        self._top = round(HEADER * height / HIGH)
        panel_height = height - self._top - round(FOOTER * height / HIGH)
        self.panel = Panel(rigid_object, recording, width // len(self._measured), panel_height, direction)

    def close(self) -> None:
        """Free the graphics card."""
        self.panel.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def draw(self, step: int) -> Image.Image:
        """The picture of one step."""
        picture = Image.new("RGB", self.size, rgb(BACKGROUND))
        sheet = Sheet(*self.size)
        sheet.line([(sheet.wide / 2, 56), (sheet.wide / 2, HIGH - FOOTER)], 0.75, LINE)
        x = EDGE + sheet.text(EDGE, 26, self._heading.name, 22, INK) + 14
        sheet.text(x, 29, self._heading.details, 12, MUTED)
        for simulation in range(len(self._measured)):
            left = simulation * self.panel.width
            pixels, labels = self.panel.draw(step, simulation)
            picture.paste(Image.fromarray(pixels), (left, self._top))
            self._number(sheet, labels, left)
            self._caption(sheet, simulation, step, left / sheet.point + EDGE)
        self._chart(sheet, step)
        self._notes(sheet, step)
        return sheet.over(picture)

    def _number(self, sheet: Sheet, labels: list[Label], left: int) -> None:
        for finger, label in enumerate(labels, start=1):
            x, y = (left + label.column) / sheet.point, (self._top + label.row) / sheet.point
            sheet.dot(x, y, 9, CONE, FAINT if label.hidden else 1.0)
            sheet.text(x, y, str(finger), 11, "#ffffff", "mm")

    def _caption(self, sheet: Sheet, simulation: int, step: int, x: float) -> None:
        """Cap, slip, and the outcome as soon as it is known."""
        recording, measured = self.recording, self._measured[simulation]
        cap = float(measured.caps[0])
        words = f"cap {cap / recording.need:g} {self._heading.need} = {cap:.4g} N"
        width = sheet.text(x, 64, words, 17, INK)
        if word := known_outcome(measured, step, recording.experiment.protocol):
            sheet.pill(x + width + 12, 64, word.upper(), 12, HELD if word == "held" else SLIPPED)
        sheet.text(x, 84, recording.slip_words(measured, step), 12, MUTED)

    def _chart(self, sheet: Sheet, step: int) -> None:
        recording = self.recording
        chart = Chart(
            left=EDGE + 40,
            top=HIGH - FOOTER + 30,
            right=sheet.wide - EDGE - NOTES - 36,
            bottom=HIGH - 26,
            protocol=recording.experiment.protocol,
            soft=self._soft,
        )
        colors = [HELD if held else SLIPPED for held in recording.measurement.held]
        curves = [measured.gone(chart.protocol) for measured in self._measured]
        chart.draw(sheet, recording.times, curves, colors, step)

    def _notes(self, sheet: Sheet, step: int) -> None:
        """What the picture shows, beside the chart."""
        x, y = sheet.wide - EDGE - NOTES, HIGH - FOOTER + 30
        factor = self.panel.factor
        sheet.text(x, y, f"MuJoCo after {self.recording.times[step]:.2f} s", 12, INK)
        sheet.text(
            x, y + 19, f"motion drawn {factor} times larger" if factor > 1 else "motion drawn as it is", 12, MUTED
        )
        if self.panel.has_edges:
            sheet.text(x, y + 38, "thin lines: where it was planned", 12, MUTED)
        force = "force and torque" if self._soft else "measured force"
        for color, words in ((FORCE, force), (LOAD, "load"), (CONE, "cone")):
            sheet.dot(x + 4, y + 57, 4, color, 0.45 if color == CONE else 1.0)
            x += sheet.text(x + 12, y + 57, words, 12, MUTED) + 24


def _check(size: tuple[int, int], direction: tuple[float, float] | None) -> None:
    """Refuse pictures that cannot be read or drawn."""
    width, height = size
    if not all(least <= asked <= most for least, asked, most in zip(LEAST, size, MOST, strict=True)):
        raise SettingError(
            f"a picture of {width} x {height} pixels; allowed: {LEAST[0]} x {LEAST[1]} to {MOST[0]} x {MOST[1]}"
        )
    if width < NARROWEST * height:
        raise SettingError(
            f"a picture of {width} x {height} pixels is too narrow for two simulations side by side; "
            "make it at least 4 : 3"
        )
    if direction is not None and not (np.isfinite(direction[0]) and -90 < direction[1] < 90):
        raise SettingError(
            f"the view is {direction[0]}, {direction[1]} degrees; allowed: any azimuth, and from -90 to 90 downwards"
        )
