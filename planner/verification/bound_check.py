"""Does a set of cuts prove a bound on rho for every subset? Checked without a solver and without the search.

The claim: for every m-subset N that has the right number of fingers of each kind and keeps spacing and span,

    min_k sum_{i in N} s_i a_i(lambda_k) <= 1 / bound,

s_i the strength of the finger at candidate i. It is settled by enumeration when there are few subsets, otherwise by
groups of candidates, split until every row of groups is covered by one cut (`planner.verification.groups`). For two
fingers in space the moment about the line through the pair counts as one more cut.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, combinations, islice, product

import numpy as np

from planner.arrays import Floats, Indices
from planner.contact_models.models import free_to_turn
from planner.errors import CandidateError
from planner.grasps.grasp import Certificate
from planner.progress import Done
from planner.verification.capacities import cut_values
from planner.verification.groups import Groups, group_candidates

MOST_ENUMERATED = 100_000
"""Subsets up to which enumeration is used: a second."""

BATCH = 2048
"""Rows of groups that are split together."""

CUTS_AT_ONCE = 64
"""Cuts entered in the table before the check may be stopped."""

ALMOST = 1 - 1e-9
"""Share that is stated at most where subsets are left, however few."""

ROUNDING = 1e-9
"""Relative slack for the rounding of a sum of a few numbers."""

ROUND_OFF = 1e-14
"""Of a cross product, relative to its factors: a few dozen times the spacing of floating point numbers."""


@dataclass(frozen=True, kw_only=True)
class BoundCheck:
    """Outcome of checking a certificate."""

    method: str
    """`enumeration` or `groups`."""

    share: float = 1.0
    """Of the subsets, how many are settled, 0 to 1; less than 1 where the check was stopped."""

    counterexample: tuple[int, ...] = ()
    """A subset that no cut covers."""

    weaker: float = 0.0
    """What the cuts do prove for the counterexample: a bound on its rho [N]."""

    @property
    def proven(self) -> bool:
        """Whether every subset is covered."""
        return self.share == 1 and not self.counterexample


@dataclass(frozen=True, eq=False)
class Claim:
    """No subset of so many candidates resists W_R with less than a force level."""

    fingers: int
    """Size m of the subsets."""

    reference_point: Floats
    """p_o, shape (d,) [m]."""

    wrenches: Floats
    """Vertices of W_R, shape (l, D) [N, N m]."""

    bound: float
    """Lower bound on rho [N]."""

    @property
    def most(self) -> float:
        """What no subset may exceed, rounding included [1/N]."""
        return (1 + ROUNDING) / self.bound


def check_bound(
    certificate: Certificate,
    claim: Claim,
    observe: Done = lambda _: None,
    stop: Callable[[], bool] = lambda: False,
) -> BoundCheck:
    """Check that no subset of the candidates has rho below a bound.

    Args:
        certificate: Candidates, cuts, and what every subset must keep to.
        claim: What they are to prove.
        observe: Called now and then with the number of subsets that are settled.
        stop: Asked again and again; once true, the check ends with the share that is settled.

    Raises:
        CandidateError: If the kinds of fingers do not add up to the fingers claimed.
    """
    candidates, fingers = certificate.candidates, claim.fingers
    counts = [(kind.fingers, kind.candidates) for kind in certificate.kinds] or [(fingers, len(candidates))]
    if sum(count for count, _ in counts) != fingers:
        raise CandidateError(f"the kinds of fingers {certificate.kinds} do not add up to {fingers} fingers")
    table = np.empty((len(candidates), len(certificate.cuts)))
    for start in range(0, len(certificate.cuts), CUTS_AT_ONCE):
        if stop():
            return BoundCheck(method="groups", share=0.0)
        some = slice(start, start + CUTS_AT_ONCE)
        table[:, some] = cut_values(candidates, claim.reference_point, certificate.cuts[some], claim.wrenches)
    table *= certificate.strengths[:, None]
    if free_to_turn(candidates, fingers):
        return _check_pairs(certificate, table, claim, stop)
    groups = group_candidates(candidates.points, candidates.normals, [count for _, count in counts], table)
    check = _Check(
        groups=groups,
        spacing=certificate.spacing,
        span=certificate.span,
        most=claim.most,
        subsets=certificate.subsets(fingers),
        observe=observe,
        stop=stop,
    )
    if check.subsets <= MOST_ENUMERATED:
        return check.enumerate(counts)
    return check.split([count for count, _ in counts])


@dataclass(frozen=True, eq=False, kw_only=True)
class _Check:
    """One check: groups of candidates, the claim, and who is told of the progress."""

    groups: Groups
    spacing: float
    span: float
    most: float
    subsets: int
    observe: Done
    stop: Callable[[], bool]

    def enumerate(self, counts: list[tuple[int, int]]) -> BoundCheck:
        """All subsets, one by one; `counts` are the fingers and candidates of each kind."""
        subsets, settled = _subsets(counts), 0
        single = np.flatnonzero(self.groups.size == 1)
        group_of = single[np.argsort(self.groups.first[single])]
        while batch := list(islice(subsets, BATCH)):
            if self.stop():
                return self.stopped("enumeration", settled)
            open_ = self.open(group_of[np.array(batch)])
            if len(open_):
                return self.refuted("enumeration", open_[-1])
            settled += len(batch)
            self.observe(settled)
        return BoundCheck(method="enumeration")

    def split(self, fingers: list[int]) -> BoundCheck:
        """Rows of groups, depth first; `fingers` is how many there are of each kind."""
        settled = 0.0
        rows = np.repeat(np.arange(len(fingers)), fingers)[None]
        while len(rows):
            if self.stop():
                return self.stopped("groups", settled)
            rows, children = rows[:-BATCH], self.groups.split(rows[-BATCH:])
            open_ = self.open(children)
            settled += float(self.groups.subsets(children).sum() - self.groups.subsets(open_).sum())
            self.observe(round(settled))
            single = open_[(self.groups.size[open_] == 1).all(axis=1)]
            if len(single):
                return self.refuted("groups", single[-1])
            rows = np.concatenate([rows, open_])
        return BoundCheck(method="groups")

    def open(self, rows: Indices) -> Indices:
        """The rows that keep their distances and are covered by no cut, the worst covered last."""
        rows = rows[self.groups.possible(rows, self.spacing, self.span)]
        sums = self.groups.least_sums(rows)
        return rows[np.argsort(sums)][(sums <= self.most).sum() :]

    def refuted(self, method: str, row: Indices) -> BoundCheck:
        """The verdict on a row of single candidates that is open."""
        subset = tuple(sorted(self.groups.first[row].tolist()))
        weaker = 1 / float(self.groups.least_sums(row[None])[0])
        return BoundCheck(method=method, counterexample=subset, weaker=weaker)

    def stopped(self, method: str, settled: float) -> BoundCheck:
        """No verdict on the subsets that are left, of which there is one at least."""
        return BoundCheck(method=method, share=min(settled / self.subsets, ALMOST))


def _subsets(counts: list[tuple[int, int]]) -> Iterator[tuple[int, ...]]:
    """Every choice of candidates: for each kind as many as it has fingers."""
    choices, start = [], 0
    for fingers, candidates in counts:
        choices.append(combinations(range(start, start + candidates), fingers))
        start += candidates
    return (tuple(chain(*parts)) for parts in product(*choices))


def _check_pairs(certificate: Certificate, table: Floats, claim: Claim, stop: Callable[[], bool]) -> BoundCheck:
    """All pairs of contacts in space: covered by a cut, or by the moment W_R asks about their line."""
    kind, alike = certificate.kind, len(certificate.kinds) < 2  # else there is one finger of each kind
    points = certificate.candidates.points
    for first in range(len(points) - 1):
        if stop():
            left = (len(points) - first) * (len(points) - first - 1)
            return BoundCheck(method="enumeration", share=1 - left / (len(points) * (len(points) - 1)))
        distances = np.linalg.norm(points - points[first], axis=1)
        possible = (distances >= certificate.spacing) & (distances <= certificate.span)
        possible &= alike | (kind != kind[first])
        others = first + 1 + np.flatnonzero(possible[first + 1 :])
        others = others[_turning(certificate, claim, first, others) > claim.most]
        least = (table[first] + table[others]).min(axis=1, initial=np.inf)
        if (least > claim.most).any():
            pair = (first, int(others[least.argmax()]))
            return BoundCheck(method="enumeration", counterexample=pair, weaker=1 / float(least.max()))
    return BoundCheck(method="enumeration")


def _turning(certificate: Certificate, claim: Claim, first: int, others: Indices) -> Floats:
    """Bounds on 1 / rho of one contact paired with others, from the moment about their line, shape (others,) [1/N].

    A contact does at most s |v| + s gamma |omega . n| along a direction that moves it with velocity v and turns it with
    omega; here v is zero but for rounding, by which it counts as larger and what is asked as smaller. So a moment that
    is zero but for rounding bounds nothing.
    """
    candidates, strengths = certificate.candidates, certificate.strengths
    points, normals, torsions = candidates.points - claim.reference_point, candidates.normals, candidates.torsions
    arm, arms = points[first], points[others]
    lines = np.where((arms == arm).all(axis=1, keepdims=True), [1.0, 0.0, 0.0], arms - arm)
    forces = np.cross(arm, lines)
    lengths = np.linalg.norm(lines, axis=1)
    products = lengths * (np.linalg.norm(arm) + np.linalg.norm(arms, axis=1))
    largest_force, largest_moment = (np.linalg.norm(part, axis=1).max() for part in np.split(claim.wrenches, 2, axis=1))
    asked = np.abs(forces @ claim.wrenches[:, :3].T + lines @ claim.wrenches[:, 3:].T).max(axis=1)
    asked -= ROUND_OFF * (products * largest_force + lengths * largest_moment)
    own = np.linalg.norm(forces + np.cross(lines, arm), axis=1) + ROUND_OFF * products
    own += torsions[first] * np.abs(lines @ normals[first])
    other = np.linalg.norm(forces + np.cross(lines, arms), axis=1) + ROUND_OFF * products
    other += torsions[others] * np.abs(np.einsum("id,id->i", lines, normals[others]))
    done = strengths[first] * own + strengths[others] * other
    return np.divide(done, asked, out=np.full(len(arms), np.inf), where=asked > 0)
