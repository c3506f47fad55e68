"""The inner problem as the textbook states it: a second-order cone program without contact frames.

    |f_i - (n_i . f_i) n_i| <= mu_i n_i . f_i,   |f_i| <= s_i phi

Source: Watanabe and Yoshikawa, eq. (3) and (7).
"""

from typing import Any

import numpy as np

from planner.arrays import Floats
from planner.forces.cvxpy_forces import CvxpyForces


class ReferenceForces(CvxpyForces):
    """Subproblem 2 with norms."""

    def tangent_map(self, normal: Floats) -> Floats:
        """I - n n^T, shape (d, d)."""
        return np.eye(len(normal)) - np.outer(normal, normal)

    def inequalities(self, cap: Any, force: Any, limit: Any, tangential: Any) -> list[Any]:
        import cvxpy as cp

        return [cp.norm(tangential) <= limit, cp.norm(force) <= cap]
