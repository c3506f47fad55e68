"""The best partner for a few chosen candidates, judged by the cut table."""

import numpy as np

from planner.search.compiled.compile import compiled


@compiled("Tuple((i8, f8))(f8[:, :], f8[::1], i8[::1], i8[::1], f8)")
def best_partner(
    values: np.ndarray, base: np.ndarray, decisive: np.ndarray, among: np.ndarray, least: float
) -> tuple[int, float]:
    """The candidate i with the largest min_k (base_k + a_ik), if that exceeds `least`; else -1.

    Args:
        values: a_i(lambda_k), shape (n, at least cuts) [1/N].
        base: What the others do along each cut, shape (cuts,) [1/N].
        decisive: Cuts looked at first, because they decide nearly always.
        among: Candidates that may be chosen.
        least: What the candidate must exceed [1/N].
    """
    chosen, best = -1, least
    for i in among:
        score = np.inf
        for cut in decisive:
            score = min(score, base[cut] + values[i, cut])
            if score <= best:
                break
        if score <= best:
            continue
        for cut in range(len(base)):
            score = min(score, base[cut] + values[i, cut])
            if score <= best:
                break
        if score > best:
            chosen, best = i, score
    return chosen, best
