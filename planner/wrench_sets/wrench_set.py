"""What every required external force set W_R can do.

A wrench is (force, moment) about the reference point p_o in the axes of the body frame B: shape (D,) with
D = 3 in the plane and D = 6 in space [N, N m]. The planner needs a polytope, so a set that is none gives
the vertices of one that contains it. Source: Watanabe and Yoshikawa, sections 2.3 and 3, eq. (5).
"""

from typing import Protocol

from planner.arrays import Floats


class WrenchSet(Protocol):
    """A convex set of wrenches that the grasp must resist."""

    def vertices(self) -> Floats:
        """Vertices of a polytope that contains the set, without repetition, shape (l, D) [N, N m].

        Raises:
            TaskError: When the polytope asked for is out of bounds.
        """

    def support(self, directions: Floats) -> Floats:
        """Support function of the set itself: max { u.w : w in the set }.

        Args:
            directions: u, shape (k, D).

        Returns:
            Shape (k,).
        """
