"""Groups of candidates that stand for many subsets at once, and whether one cut covers them all.

A row (g_1, ..., g_m) of groups stands for the subsets that take one candidate from each; a group that appears r
times in it gives r different ones. With U_g(k) = max_{i in g} a_i(lambda_k), a cut k with

    sum_j U_{g_j}(k) <= 1 / bound

covers every subset of the row. A row that no cut covers is split: its widest group falls into two, and r copies of it
become t copies of the first and r - t of the second, t = 0, ..., r. So every subset is settled exactly once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from planner.arrays import Floats, Indices, Mask

NUMBERS_AT_ONCE = 2**18
"""Sums formed together: they fit a processor's cache."""

SMALLEST = 1e-12
"""Width of a group whose candidates coincide: such a group can still be split."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Groups:
    """A binary tree of groups for each kind of finger, the kinds first; the halves of a group have larger numbers."""

    first: Indices
    """Any candidate of each group, shape (groups,)."""

    size: Indices
    """Candidates in each group, shape (groups,)."""

    half: Indices
    """First half of each group, the second is the next number; -1 for single candidates. Shape (groups,)."""

    width: Floats
    """Diagonal of the bounding box in (position, normal), zero for single candidates only, shape (groups,)."""

    lower: Floats
    """Least coordinates of each group's points, shape (groups, d) [m]."""

    upper: Floats
    """Greatest coordinates of each group's points, shape (groups, d) [m]."""

    largest: Floats
    """U, shape (groups, cuts) [1/N]."""

    def possible(self, rows: Indices, spacing: float, span: float) -> Mask:
        """Which rows may hold a subset whose contacts keep their distances, shape (rows,); exact for single ones.

        Args:
            rows: Groups, shape (rows, m).
            spacing: Least distance between two contacts [m].
            span: Greatest distance between two contacts [m].
        """
        possible = np.ones(len(rows), dtype=bool)
        if spacing > 0 or span < np.inf:
            for one, other in combinations(rows.T, 2):
                near = np.maximum(self.lower[one] - self.upper[other], self.lower[other] - self.upper[one]).clip(0)
                far = np.maximum(self.upper[one] - self.lower[other], self.upper[other] - self.lower[one])
                possible &= (np.linalg.norm(near, axis=1) <= span) & (np.linalg.norm(far, axis=1) >= spacing)
        return possible

    def least_sums(self, rows: Indices) -> Floats:
        """min_k sum_j U_{g_j}(k) of each row, shape (rows,) [1/N]; infinite without cuts."""
        least = np.empty(len(rows))
        step = max(1, NUMBERS_AT_ONCE // max(1, self.largest.shape[1]))
        for start in range(0, len(rows), step):
            part = rows[start : start + step].T
            sums = self.largest[part[0]]
            for group in part[1:]:
                sums += self.largest[group]
            least[start : start + step] = sums.min(axis=1, initial=np.inf)
        return least

    def subsets(self, rows: Indices) -> Floats:
        """Subsets that each row stands for, shape (rows,): the product of binomials, exact up to rounding."""
        copy = np.tril(rows[:, :, None] == rows[:, None, :]).sum(axis=2)  # 1 for the first of a group's copies, ...
        return ((self.size[rows] - copy + 1) / copy).prod(axis=1)

    def split(self, rows: Indices) -> Indices:
        """Rows, shape (children, m), that together stand for the same subsets; none may be single throughout."""
        widest = np.take_along_axis(rows, self.width[rows].argmax(axis=1)[:, None], axis=1)
        is_copy = rows == widest
        copy, copies = is_copy.cumsum(axis=1), is_copy.sum(axis=1)
        half = self.half[widest[:, 0]]
        children = []
        for low in range(rows.shape[1] + 1):
            possible = (low <= copies) & (low <= self.size[half]) & (copies - low <= self.size[half + 1])
            children.append(np.where(is_copy, half[:, None] + (copy > low), rows)[possible])
        return np.concatenate(children)


def group_candidates(points: Floats, normals: Floats, counts: Sequence[int], table: Floats) -> Groups:
    """Halve the candidates of each kind, and their halves, until every group is a single candidate.

    Args:
        points: Shape (n, d) [m].
        normals: Shape (n, d).
        counts: Candidates of each kind; they follow each other.
        table: a_i(lambda_k), shape (n, cuts) [1/N].
    """
    centred = points - points.mean(axis=0)
    places = np.hstack([centred / (np.abs(centred).max() or 1.0), normals])
    members: list[Indices] = [*np.split(np.arange(len(points)), np.cumsum(counts)[:-1])]
    half = []
    for group in members:  # which grows by its halves, to 2 n - 1 groups for each kind
        half.append(len(members) if len(group) > 1 else -1)
        if len(group) > 1:
            members += _halves(places, group)
    largest = np.empty((len(members), table.shape[1]))
    for number in reversed(range(len(members))):
        first = half[number]
        largest[number] = table[members[number][0]] if first < 0 else largest[first : first + 2].max(axis=0)
    size = np.array([len(group) for group in members])
    width = np.array([np.linalg.norm(np.ptp(places[group], axis=0)) for group in members])
    return Groups(
        first=np.array([group[0] for group in members]),
        size=size,
        half=np.array(half),
        width=np.where(size > 1, np.maximum(width, SMALLEST), 0.0),
        lower=np.array([points[group].min(axis=0) for group in members]),
        upper=np.array([points[group].max(axis=0) for group in members]),
        largest=largest,
    )


def _halves(places: Floats, group: Indices) -> list[Indices]:
    """A group cut in the middle of the longest side of its bounding box; where its members coincide, by count."""
    inside = places[group]
    lower, upper = inside.min(axis=0), inside.max(axis=0)
    side = (upper - lower).argmax()
    low = inside[:, side] <= (lower + upper)[side] / 2
    if low.all():
        low = np.arange(len(group)) < len(group) // 2
    return [group[low], group[~low]]
