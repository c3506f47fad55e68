"""Bounds of rows of tree nodes from the cut table.

With U[C, k] = max of a_i(lambda_k) over the candidates below node C,

    1 / rho_N  <=  min_k sum_j U[C_j, k]      for every subset N the row (C_1, ..., C_m) stands for.
"""

import numpy as np

from planner.search.cuts import CutTable
from planner.search.tree import CandidateTree

BLOCK = 64
"""Cuts checked together; rows that a block kills are not checked against older blocks."""


class NodeBounds:
    """U for all nodes, extended as the cut table grows, and the cuts that killed something."""

    def __init__(self, tree: CandidateTree, cuts: CutTable) -> None:
        self._tree, self._cuts = tree, cuts
        self._maxima = np.empty((len(tree.start), BLOCK))
        self._count = 0
        self.useful: set[int] = set()
        """Cuts that have pruned a row: they are the proof."""

    def extend(self) -> None:
        """Compute U for the cuts added since the last call."""
        while self._maxima.shape[1] < len(self._cuts):
            self._maxima = np.concatenate([self._maxima, np.empty_like(self._maxima)], axis=1)
        for cut in range(self._count, len(self._cuts)):
            self._maxima[:, cut] = self._tree.maxima(self._cuts.values[cut])
        self._count = len(self._cuts)

    def bound(self, rows: np.ndarray, threshold: float, since: int = 0) -> np.ndarray:
        """Upper bounds on 1 / rho of the rows, newest cuts first [1/N].

        Args:
            rows: Node numbers, shape (rows, m).
            threshold: Rows whose bound falls to this value or below need no further cuts.
            since: Only cuts from this number on are checked.

        Returns:
            Shape (rows,); a value at or below the threshold is the bound of the cut that killed the row.
        """
        bounds = np.full(len(rows), np.inf)
        alive = np.arange(len(rows))
        for last in range(self._count, since, -BLOCK):
            first = max(since, last - BLOCK)
            sums = self._maxima[rows[alive, 0], first:last]
            for slot in range(1, rows.shape[1]):
                sums += self._maxima[rows[alive, slot], first:last]
            sharpest = sums.argmin(axis=1)
            value = sums[np.arange(len(alive)), sharpest]
            bounds[alive] = np.minimum(bounds[alive], value)
            killed = value <= threshold
            self.useful.update((first + sharpest[killed]).tolist())
            alive = alive[~killed]
            if not len(alive):
                break
        return bounds
