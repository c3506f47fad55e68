"""A trial on the page: its playback, where it is, its controls and its chart."""

import viser

from sim.view.chart import Chart
from sim.view.controls import Controls
from sim.view.playback import Playback
from sim.view.player import Player


class Screening:
    """From when a trial is shown until another one is, or the plan."""

    def __init__(self, gui: viser.GuiApi, controls: Controls, playback: Playback, before: Player | None) -> None:
        """
        Args:
            gui: Of the page.
            controls: Its panel.
            playback: What is shown.
            before: Where the trial was that was shown before, if one was: wrenches are compared at the same instant.
        """
        self.playback, self._controls = playback, controls
        timestep = playback.recording.experiment.protocol.timestep
        at, playing = (before.at, before.playing) if before else (0.0, True)
        self.player = Player(timestep=timestep, last=playback.last, at=min(at, float(playback.last)), playing=playing)
        controls.take_playback(playback.last, timestep, playback.factor)
        controls.tell_playback(self.player.step, self.player.playing)
        with controls.playback:
            self.chart = Chart(gui, playback)

    def advance(self, seconds: float) -> None:
        """Let time pass [s], from where the visitor has put the playback."""
        self.player.seek(self._controls.step)
        if self._controls.wants_toggle():
            self.player.toggle()
        self.player.advance(seconds)
        self._controls.tell_playback(self.player.step, self.player.playing)

    @property
    def factor(self) -> int:
        """By how much the motion is drawn larger."""
        return self.playback.factor if self._controls.enlarged else 1

    def close(self) -> None:
        """Take it off the page."""
        self.chart.remove()
        self._controls.leave_playback()
