"""A control: simulations whose outcome the theory predicts and the verdict does not depend on.

An experiment that cannot fail proves nothing, nor does one that fails by itself. If a control does not turn out as
predicted, the experiment is not to be trusted, and neither is its verdict.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False, kw_only=True)
class ControlExperiment:
    """One change to the experiment with its predicted and its observed outcome, per simulation."""

    name: str

    change: str
    """What was changed, in words."""

    wrenches: np.ndarray
    """Index of each simulation's wrench, shape (simulations,); -1 for no wrench."""

    phi: np.ndarray
    """Predicted cap under the change, shape (simulations,) [N]; infinite where no cap suffices."""

    caps: np.ndarray
    """Simulated cap, shape (simulations,) [N]."""

    slips: np.ndarray
    """Largest slip of a loaded finger over R0, shape (simulations,)."""

    spins: np.ndarray
    """Largest spin of a loaded soft finger, shape (simulations,) [rad]."""

    held: np.ndarray
    """Whether the simulation was held, shape (simulations,)."""

    expected: np.ndarray
    """Whether the theory says it is held, shape (simulations,)."""

    counted: np.ndarray
    """Whether the prediction is far enough from the cap to be called, shape (simulations,)."""

    @property
    def wrong(self) -> np.ndarray:
        """Simulations that contradict their prediction, shape (simulations,)."""
        return self.counted & (self.held != self.expected)

    @property
    def behaved(self) -> bool:
        """Whether everything that counts turned out as predicted."""
        return not self.wrong.any()

    def outcome(self) -> str:
        """What happened, in words."""
        if not len(self.held):
            return "not possible on this grasp"
        slipped, held = (self.counted & ~self.held).sum(), (self.counted & self.held).sum()
        words = [f"{count} {verb}" for count, verb in ((held, "held"), (slipped, "slipped")) if count]
        near = (~self.counted).sum()
        note = f" ({near} too near to call)" if near else ""
        if self.behaved:
            return f"{', '.join(words) or 'none counted'} as predicted{note}"
        return f"{', '.join(words)}, of which {self.wrong.sum()} against the prediction{note}"

    def doubt(self) -> str | None:
        """Why the experiment is not to be trusted; None if the control behaved."""
        if self.behaved:
            return None
        first = int(self.wrong.argmax())
        wrench = f"wrench {self.wrenches[first]}" if self.wrenches[first] >= 0 else "no load"
        did = "held" if self.held[first] else "slipped"
        return (
            f"control '{self.name}' did not behave ({self.change}): {self.wrong.sum()} of {self.counted.sum()} "
            f"outcomes against the prediction; {wrench} {did} ({self._seen(first)}) with the cap at "
            f"{self.caps[first]:.5g} N where phi is {self.phi[first]:.5g} N"
        )

    def _seen(self, simulation: int) -> str:
        """What a simulation showed, in words; a spin where there is one."""
        slip, spin = float(self.slips[simulation]), float(self.spins[simulation])
        return f"slip {slip:.2g} R0" + (f", spin {spin:.2g} rad" if spin else "")
