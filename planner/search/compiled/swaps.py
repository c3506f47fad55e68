"""The best partner for a few chosen candidates, judged by the cut table."""

import numpy as np

from planner.arrays import Floats, Indices
from planner.search.compiled.compile import compiled

DECISIVE = 16
"""Cuts looked at first: those along which the chosen candidates do least decide nearly always."""


@compiled("Tuple((i8, f8))(f8[:, :], i8[::1], i8[::1], f8)")
def best_partner(values: Floats, chosen: Indices, among: Indices, least: float) -> tuple[int, float]:
    """The candidate i with the largest min_k (a_ik + sum over the chosen of a_jk), if that exceeds `least`; else -1.

    Args:
        values: a_i(lambda_k), shape (n, cuts) [1/N].
        chosen: The candidates it joins.
        among: Candidates that may be taken, except the chosen ones.
        least: What the smallest sum must exceed [1/N].
    """
    cuts = values.shape[1]
    base, first = np.zeros(cuts), np.empty(min(DECISIVE, cuts), np.int64)
    for j in chosen:
        for cut in range(cuts):
            base[cut] += values[j, cut]
    for place in range(len(first)):  # the smallest of every sixteenth cut
        smallest = place
        for cut in range(place, cuts, len(first)):
            if base[cut] < base[smallest]:
                smallest = cut
        first[place] = smallest
    best, score = -1, least
    for i in among:
        taken = False
        for j in chosen:
            taken = taken or j == i
        if taken:
            continue
        worst = np.inf
        for cut in first:
            worst = min(worst, base[cut] + values[i, cut])
            if worst <= score:
                break
        if worst <= score:
            continue
        for cut in range(cuts):
            worst = min(worst, base[cut] + values[i, cut])
            if worst <= score:
                break
        if worst > score:
            best, score = i, worst
    return best, score
