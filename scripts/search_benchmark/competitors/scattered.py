"""All m-subsets of n candidates in a scattered order, so that a part of the enumeration speaks for the whole.

Number k of the order is the subset of rank (k s) mod C(n, m), with s prime to C(n, m) and close to the golden section
of it: every subset comes once, and any run of consecutive numbers is spread evenly over all ranks. A rank r becomes a
subset c_m > ... > c_1 by r = C(c_m, m) + ... + C(c_1, 1), the combinatorial number system.
"""

from bisect import bisect_right
from math import comb, gcd

import numpy as np

from planner.arrays import Indices


class ScatteredSubsets:
    """A sequence of C(n, m) subsets, computed and never stored."""

    def __init__(self, candidates: int, fingers: int) -> None:
        self._total = comb(candidates, fingers)
        self._columns = [[comb(c, size) for c in range(candidates)] for size in range(fingers, 0, -1)]
        self._stride = max(1, self._total * 618_034 // 1_000_000)
        while gcd(self._stride, self._total) != 1:
            self._stride += 1

    def __len__(self) -> int:
        return self._total

    def __getitem__(self, number: int) -> Indices:
        """Subset of one number in 0 <= number < C(n, m), shape (m,), ascending."""
        rank = number * self._stride % self._total
        members = []
        for column in self._columns:
            member = bisect_right(column, rank) - 1
            rank -= column[member]
            members.append(member)
        return np.array(members[::-1])
