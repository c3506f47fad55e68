"""The page's panel. Nothing calls back: the viewer reads the controls many times a second, and writes them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import viser

from sim.view.subject import Subject

PLAN, TRIAL = "the plan", "the trial in MuJoCo"
"""What can be shown."""
LEGEND = (
    "orange: forces and torques · violet: the wrench · blue: friction cones · "
    "thin lines: where a lost object was planned"
)


class Controls:
    """What a visitor can ask for, and what the visitor is told.

    Whatever a browser sends is read as something that exists.
    """

    def __init__(self, gui: viser.GuiApi, names: Sequence[str]) -> None:
        """Make the panel of grasps with these names."""
        self._grasps = tuple(f"{number}: {name}" for number, name in enumerate(names, start=1))
        self._grasp = gui.add_dropdown("grasp", self._grasps, visible=len(names) > 1)
        self.about = gui.add_markdown("")
        self._shown = gui.add_dropdown("show", (PLAN, TRIAL))
        self._wrench = gui.add_slider("wrench", 0, 1, 1, 0)
        self._critical = gui.add_button("critical wrench", color="gray")
        self.asked = gui.add_markdown("")
        self.playback = gui.add_folder("playback", visible=False)
        with self.playback:
            self._play = gui.add_button("pause")
            self._step = gui.add_slider("step", 0, 1, 1, 0)
            self._enlarged = gui.add_checkbox("enlarge", initial_value=True)
        self.forces = gui.add_markdown("")
        gui.add_markdown(LEGEND)

    @property
    def grasp(self) -> int:
        """Which grasp is asked for."""
        return self._grasps.index(self._grasp.value) if self._grasp.value in self._grasps else 0

    @property
    def trial(self) -> bool:
        """Whether the trial is asked for, and not the plan."""
        return self._shown.value == TRIAL

    @property
    def wrench(self) -> int:
        """Which wrench is asked for."""
        return int(np.clip(self._wrench.value, 0, self._wrench.max))

    @wrench.setter
    def wrench(self, wrench: int) -> None:
        _put(self._wrench, wrench)

    @property
    def step(self) -> int:
        """Which step of the trial is asked for."""
        return int(np.clip(self._step.value, 0, self._step.max))

    @property
    def enlarged(self) -> bool:
        """Whether the motion is to be enlarged."""
        return bool(self._enlarged.value)

    def ask(self, *, trial: bool) -> None:
        """Ask for the trial, or for the plan, in the visitor's place."""
        _put(self._shown, TRIAL if trial else PLAN)

    def take_subject(self, subject: Subject, about: str) -> None:
        """Ask for the critical wrench of another grasp."""
        self.about.content = about
        self._wrench.max = len(subject.grasp.phi) - 1
        self.wrench = subject.grasp.critical_wrench

    def take_playback(self, last: int, timestep: float, factor: int) -> None:
        """Offer the steps of a trial, and the factor by which its motion can be enlarged."""
        self._step.label, self._step.max = f"step ({1e3 * timestep:g} ms)", last
        self._enlarged.label, self._enlarged.visible = f"draw the motion {factor} times larger", factor > 1
        self.playback.visible = True

    def leave_playback(self) -> None:
        """Offer none."""
        self.playback.visible = False

    def tell_playback(self, step: int, playing: bool) -> None:
        """Say where the playback is."""
        _put(self._step, step)
        self._play.label = "pause" if playing else "play"

    def wants_critical(self) -> bool:
        """Whether the critical wrench was asked for since this was asked last."""
        return _clicked(self._critical)

    def wants_toggle(self) -> bool:
        """Whether play or pause was asked for since this was asked last."""
        return _clicked(self._play)


def _clicked(button: viser.GuiButtonHandle) -> bool:
    if not button.value:
        return False
    _put(button, False)
    return True


def _put(control: Any, value: object) -> None:
    """Set a control. Its type is too narrow: viser's own is read as read-only by mypy."""
    control.value = value
