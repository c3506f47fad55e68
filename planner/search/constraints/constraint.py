"""What the search asks of a condition on subsets beside their force.

To add one: write its file, and name it in `every_grasp`. A condition on every grasp is stated in the certificate,
and `planner.verification` keeps to it in code of its own.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from planner.arrays import Indices, Mask


class Constraint(Protocol):
    """Some subsets are wanted, the others do not count."""

    def possible(self, rows: Indices) -> Mask:
        """Which rows of regions may hold a wanted subset, shape (rows,); exact for rows of single candidates.

        Args:
            rows: Numbers of regions, shape (rows, m).
        """

    def admits(self, subsets: Indices) -> Mask:
        """Which subsets are wanted, shape (subsets,).

        Args:
            subsets: Candidate indices, shape (subsets, m).
        """

    def stated(self) -> dict[str, float]:
        """What a certificate has to say of it, by the names of its fields; empty where its bound is about all."""


class Constraints:
    """Several at once."""

    def __init__(self, constraints: Sequence[Constraint]) -> None:
        self._constraints = constraints

    def possible(self, rows: Indices) -> Mask:
        """See `Constraint.possible`."""
        possible = np.ones(len(rows), dtype=bool)
        for constraint in self._constraints:
            possible &= constraint.possible(rows)
        return possible

    def admits(self, subsets: Indices) -> Mask:
        """See `Constraint.admits`."""
        wanted = np.ones(len(subsets), dtype=bool)
        for constraint in self._constraints:
            wanted &= constraint.admits(subsets)
        return wanted

    def admit(self, subset: Indices) -> bool:
        """Whether one subset, shape (m,), is wanted."""
        return bool(self.admits(subset[None])[0])

    def stated(self) -> dict[str, float]:
        """See `Constraint.stated`."""
        return {name: value for constraint in self._constraints for name, value in constraint.stated().items()}
