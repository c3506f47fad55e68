"""A binary tree of regions of contacts: all that the search asks of where fingers may go.

What bounds, splits and excludes rows of regions sees this and nothing else. A region is a cluster: the contacts below
it (`candidate_tree`). Or it is a patch of a surface: all places between the contacts below it, its corners. To the cut
table that is the same, for over a convex piece of a facet the support function h, convex in the place, is largest at a
corner. Only, a patch gives as many different contacts as one likes, and at a width of zero is not split any more.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Indices


@dataclass(frozen=True, eq=False, kw_only=True)
class RegionTree:
    """Regions numbered parents first, the two children of one with consecutive numbers; one root per kind of finger."""

    order: Indices
    """The n contacts of the cut table, neighbours in the tree next to each other, shape (n,)."""

    left: Indices
    """Left child of each region (the right one is the next number), -1 for a single contact, shape (regions,)."""

    contact: Indices
    """A contact in each region, shape (regions,): that one where it has no children."""

    sizes: Indices
    """How many different contacts a region can give, at least 1, shape (regions,)."""

    diameters: Floats
    """How wide each region is, in one unit; zero for those that are not split, positive for all others, shape
    (regions,)."""

    first_row: Indices
    """The roots, once for each finger: the row of regions that stands for every choice, shape (m,)."""

    def spread(self, count: int) -> Indices:
        """Contacts of at most that number, taken evenly from their order, shape (spread,)."""
        return self.order[:: -(-len(self.order) // count)]

    def boxes(self, points: Floats) -> tuple[Floats, Floats]:
        """Least and greatest coordinates in each region.

        Args:
            points: Of each contact, shape (n, d); linear along a patch, as positions are.

        Returns:
            Two arrays of shape (regions, d).
        """
        lower, upper = points[self.contact], points[self.contact]
        for node in np.flatnonzero(self.left >= 0)[::-1]:
            children = slice(self.left[node], self.left[node] + 2)
            lower[node], upper[node] = lower[children].min(axis=0), upper[children].max(axis=0)
        return lower, upper
