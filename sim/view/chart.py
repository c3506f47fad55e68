"""The measurement on the page: slip over time on a logarithmic scale, and the line that a hold stays under."""

import numpy as np
import viser
from viser.uplot import Series

from planner.arrays import Floats
from sim.render.palette import HELD, INK, SLIPPED
from sim.scene.units import WHAT_R0_IS
from sim.view.playback import Playback

EXPONENTS = (-8.0, 0.0)
"""Of ten, of the slips on the chart, relative to R0; what is beyond is drawn on its edge."""
HEIGHT = 190
"""[pixels]"""


class Chart:
    """The curves of all simulations of one playback, as far as they are known."""

    def __init__(self, gui: viser.GuiApi, playback: Playback) -> None:
        protocol, held = playback.recording.experiment.protocol, playback.recording.measurement.held
        allowed = np.full(playback.last + 1, protocol.slip_tolerance)
        slips = np.stack([*playback.gone, allowed])
        lowest, highest = EXPONENTS
        self._curves = (playback.recording.times, *np.log10(np.clip(slips, 10**lowest, 10**highest)))
        lines = [_line("held", HELD) if good else _line("slipped", SLIPPED) for good in held]
        soft = playback.subject.contacts.torsions.any()
        spin = f", or of the spin over {protocol.spin_of_reach:g} rad," if soft else ","
        self._title = gui.add_markdown(f"log10 of the largest slip over R0{spin} over time [s]; R0 is {WHAT_R0_IS}")
        self._node = gui.add_uplot(
            data=self._known(0),
            series=({"label": "s"}, *lines, {"label": "limit", "stroke": INK, "width": 1, "dash": (4, 4)}),
            scales={
                "x": {"time": False, "auto": False, "range": (0.0, protocol.duration)},
                "y": {"auto": False, "range": EXPONENTS},
            },
            axes=({"size": 28}, {"size": 36}),
            legend={"show": False},
            height=HEIGHT,
            padding=(10, 16, 0, 0),
        )

    def show(self, step: int) -> None:
        """Draw the curves up to a step."""
        self._node.data = self._known(step)

    def remove(self) -> None:
        """Take the chart away."""
        self._title.remove()
        self._node.remove()

    def _known(self, step: int) -> tuple[Floats, ...]:
        return tuple(curve[: step + 1] for curve in self._curves)


def _line(name: str, color: str) -> Series:
    return {"label": name, "stroke": color, "width": 2}
