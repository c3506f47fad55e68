"""A control: simulations whose outcome the theory predicts and the verdict does not depend on.

An experiment that cannot fail proves nothing, nor does one that fails by itself. If a control does not turn out as
predicted, the experiment is not to be trusted, and neither is its verdict.
"""

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class ControlOutcome:
    """One simulation of a control."""

    wrench: int | None
    """Index among the vertices; None for no wrench."""

    phi: float | None
    """Predicted cap under the change [N]; None where no cap suffices."""

    cap: float
    """Simulated cap [N]."""

    slip: float
    """Largest slip of a loaded finger over R0."""

    spin: float = 0.0
    """Largest spin of a loaded soft finger [rad]."""

    held: bool
    """Whether it was held."""

    expected: bool
    """Whether the theory says it is held."""

    counted: bool
    """Whether the prediction is far enough from the cap to be called."""

    @property
    def wrong(self) -> bool:
        """Whether it contradicts its prediction."""
        return self.counted and self.held != self.expected

    @property
    def seen(self) -> str:
        """What was measured, in words; a spin where there is one."""
        return f"slip {self.slip:.2g} R0" + (f", spin {self.spin:.2g} rad" if self.spin else "")


@dataclass(frozen=True, kw_only=True)
class ControlExperiment:
    """One change to the experiment with its predicted and its observed outcome, per simulation."""

    name: str

    change: str
    """What was changed, in words."""

    behaved: bool = field(init=False)
    """Whether everything that counts turned out as predicted: follows from the outcomes."""

    outcomes: tuple[ControlOutcome, ...]
    """Empty if the control is not possible on this grasp."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "behaved", not self._wrong)

    def outcome(self) -> str:
        """What happened, in words."""
        if not self.outcomes:
            return "not possible on this grasp"
        counted = [outcome.held for outcome in self.outcomes if outcome.counted]
        held, near = sum(counted), len(self.outcomes) - len(counted)
        words = [f"{count} {verb}" for count, verb in ((held, "held"), (len(counted) - held, "slipped")) if count]
        note = f" ({near} too near to call)" if near else ""
        if self.behaved:
            return f"{', '.join(words) or 'none counted'} as predicted{note}"
        return f"{', '.join(words)}, of which {len(self._wrong)} against the prediction{note}"

    def doubt(self) -> str | None:
        """Why the experiment is not to be trusted; None if the control behaved."""
        if self.behaved:
            return None
        first, counted = self._wrong[0], sum(outcome.counted for outcome in self.outcomes)
        wrench = "no load" if first.wrench is None else f"wrench {first.wrench}"
        did = "held" if first.held else "slipped"
        need = "no cap suffices" if first.phi is None else f"phi is {first.phi:.5g} N"
        return (
            f"control '{self.name}' did not behave ({self.change}): {len(self._wrong)} of {counted} outcomes against "
            f"the prediction; {wrench} {did} ({first.seen}) with the cap at {first.cap:.5g} N where {need}"
        )

    @property
    def _wrong(self) -> list[ControlOutcome]:
        return [outcome for outcome in self.outcomes if outcome.wrong]
