"""Where a playback is: it runs ten times slower than the simulation, stops at the end, and goes where it is put."""

from dataclasses import dataclass

SLOWER = 10
"""Seconds of playback per second of simulation."""


@dataclass(kw_only=True)
class Player:
    """A position in a trial."""

    timestep: float
    """Of the simulation [s]."""

    last: int
    """Its last step."""

    at: float = 0.0
    """In steps."""

    playing: bool = True

    @property
    def step(self) -> int:
        """The step that is shown."""
        return round(self.at)

    def advance(self, seconds: float) -> None:
        """Let time pass [s]."""
        if self.playing:
            self.at = min(self.at + seconds / (SLOWER * self.timestep), float(self.last))
            self.playing = self.at < self.last

    def seek(self, step: int) -> None:
        """Go to a step, if it is not the one that is shown already."""
        if step != self.step:
            self.at = float(min(max(step, 0), self.last))

    def toggle(self) -> None:
        """Pause, or play on; from the end, play again."""
        self.playing = not self.playing
        if self.playing and self.at >= self.last:
            self.at = 0.0
