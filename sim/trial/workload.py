"""How far a measurement is, in simulations: what nearly all of its time is spent on."""

from itertools import count

from planner.arrays import Floats
from planner.progress import Done, Observe
from sim.trial.trial import Observer


class Workload:
    """A measurement of several parts, told to one observer as one count."""

    def __init__(self, observe: Observe, expected: float) -> None:
        """A measurement that begins now.

        Args:
            observe: Told the progress of the whole.
            expected: Simulations of all parts.
        """
        self._observe, self._expected = observe, expected
        self._before = self._size = 0.0

    def part(self, what: str, size: float) -> "Part":
        """The next part; the one before it is done.

        Args:
            what: What its simulations are for.
            size: How many they are, as counted among the expected.
        """
        self._before, self._size = self._before + self._size, size
        part = Part(f"simulations ({what})", self._observe, self._before, size, self._expected - self._before - size)
        part(0.0)
        return part


class Part:
    """Called with how many simulations of one part are done."""

    def __init__(self, what: str, observe: Observe, before: float, size: float, after: float) -> None:
        self._what, self._observe = what, observe
        self._before, self._size, self._after = before, size, after

    def __call__(self, done: float, size: float | None = None) -> None:
        """So many are done, of as many as expected or, as is known by now, of `size`."""
        self._observe(self._what, self._before + done, self._before + (size or self._size) + self._after)


def each_step(observe: Done, simulations: int, steps: int) -> Observer:
    """An observer of steps that tells them as shares of so many simulations."""
    taken = count(1)

    def step(_: Floats, __: Floats) -> None:
        observe(simulations * next(taken) / steps)

    return step
