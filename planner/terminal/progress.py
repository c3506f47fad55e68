"""How long the rest of a piece of work will take, at the pace so far."""

PATIENCE = 2.0
"""Seconds in which nobody asks how far the work is, and that a pace needs to be known [s]."""


def seconds_left(seconds: float, done: float, total: float) -> float | None:
    """Time for the rest at the pace so far [s]; None while nothing is done."""
    return seconds * max(total - done, 0.0) / done if done > 0 else None


def in_words(seconds: float) -> str:
    """A duration as exact as an estimate deserves: 42 s, 7 min, 2 h 5 min."""
    if seconds < 120:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"


class Pace:
    """How fast a count grows. One that falls belongs to new work, and is timed anew."""

    def __init__(self) -> None:
        self._began, self._first, self._last = 0.0, 0.0, float("inf")

    def left(self, done: float, total: float, now: float) -> float | None:
        """Time for the rest [s]; None until it can be told.

        Args:
            done: How much is done.
            total: Of how much.
            now: On any clock [s].
        """
        if done < self._last:
            self._began, self._first = now, done
        self._last = done
        elapsed = now - self._began
        return seconds_left(elapsed, done - self._first, total - self._first) if elapsed >= PATIENCE else None


def progress_text(what: str, done: float, total: float, left: float | None) -> str:
    """12 of 90 grasps (mug), about 7 min left."""
    return f"{done:,.0f} of {total:,.0f} {what}" + ("" if left is None else f", about {in_words(left)} left")
