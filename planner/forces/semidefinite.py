"""The inner problem as the paper solves it: a positive semidefinite program, after Buss et al.

    F_i = | phi I   f_i |  >= 0          P_i = | mu n   0     t_1  |  >= 0
          | f_i^T   phi |                      |  0    mu n   t_2  |
                                               | t_1   t_2    mu n |

with n the normal and t_1, t_2 the tangential parts of f_i; in the plane there is no t_2, and P_i is smaller; where a
finger can twist there is one t more. For a finger of another strength than
1, s_i phi takes the place of phi. By Schur's complement F_i says |f_i| <= phi and P_i says sqrt(t_1^2 + t_2^2) <= mu n.
Source: Watanabe and Yoshikawa, section 3.1, after eq. (8); M. Buss, H. Hashimoto, J. B. Moore, "Dexterous hand grasping
force optimization", 1996.
"""

from typing import Any

import numpy as np

from planner.arrays import Floats
from planner.contacts import contact_frames
from planner.forces.cvxpy_forces import CvxpyForces


class SemidefiniteForces(CvxpyForces):
    """Subproblem 2 with linear matrix inequalities."""

    def tangent_map(self, normal: Floats) -> Floats:
        """(t_1, t_2), in the plane t_1 alone: the tangents of the contact frame, shape (d - 1, d)."""
        return contact_frames(normal[None])[0, :, 1:].T

    def inequalities(self, cap: Any, force: Any, limit: Any, tangential: Any) -> list[Any]:
        return [_arrow(cap, force) >> 0, _arrow(limit, tangential) >> 0]


def _arrow(length: Any, vector: Any) -> Any:
    """The matrix that is positive semidefinite where |vector| <= length."""
    import cvxpy as cp

    size = vector.shape[0]
    column = cp.reshape(vector, (size, 1), order="C")
    return cp.bmat([[length * np.eye(size), column], [column.T, cp.reshape(length, (1, 1), order="C")]])
