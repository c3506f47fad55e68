"""The inner problem as data: the least force level that balances one wrench.

    phi(w) = min phi   s.t.   sum_i G_i f_i = -w,   f_i in K_i,   |f_i| <= s_i phi          (Subproblem 2)

s_i is the strength of finger i, usually 1: then phi is the least largest fingertip force. Where fingers can twist, f_i
holds a torque about the normal beside the force, see `planner.contact_models`. The dual is the maximum of
-lambda . w over the directions lambda with sum_i s_i h_i(lambda) <= 1, where h_i(lambda) is the support function of
G_i (K_i ∩ B). So every direction lambda proves

    phi(w) >= -lambda . w / sum_i s_i h_i(lambda),

and one with sum_i s_i h_i(lambda) = 0 < -lambda . w proves that no force balances w at all.
Source: Watanabe and Yoshikawa, eq. (7).
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from planner.contact_models.models import model_of
from planner.contacts import Contacts, grasp_maps, reach, wrench_scale


@dataclass(frozen=True, eq=False, kw_only=True)
class ForceProblem:
    """Balance `wrench` with the contacts, the largest force over its finger's strength as small as possible."""

    contacts: Contacts
    """The grasp, in the body frame."""

    reference_point: Floats
    """p_o, shape (d,) [m]."""

    wrench: Floats
    """External wrench w about p_o, shape (D,) [N, N m]."""

    @property
    def length(self) -> float:
        """Largest distance of a contact from p_o [m]: makes moments comparable with forces."""
        return reach(self.contacts.points, self.reference_point)


@dataclass(frozen=True, eq=False, kw_only=True)
class ForceSolution:
    """Forces and the dual direction that proves them best, or that proves there are none."""

    problem: ForceProblem

    feasible: bool
    """Whether some force in the cones balances the wrench."""

    forces: Floats
    """Contact forces in the body frame, shape (contacts, d) [N]; NaN where infeasible."""

    torques: Floats
    """Contact torques about the inward normals, shape (contacts,) [N m]; NaN where infeasible."""

    phi: float
    """The force level max_i |f_i| / s_i [N]; infinite where infeasible."""

    direction: Floats
    """lambda, shape (D,): dual optimum, or infeasibility certificate; any positive scale."""

    def balance_residual(self) -> float:
        """|sum_i G_i f_i + w| with moments divided by the problem's length, relative to the size of w."""
        problem = self.problem
        scale = wrench_scale(problem.contacts.dimension, problem.length)
        maps = grasp_maps(problem.contacts.points, problem.reference_point)
        residual = np.einsum("iDd,id->D", maps, self.forces) + problem.wrench
        if problem.contacts.dimension == 3:
            residual[3:] += self.torques @ problem.contacts.normals
        return float(np.linalg.norm(scale * residual) / (np.linalg.norm(scale * problem.wrench) or 1.0))

    def cone_residual(self) -> float:
        """Largest violation of a friction cone, relative to phi."""
        contacts = self.problem.contacts
        return float(model_of(contacts).excess(self.forces, self.torques, contacts).max(initial=0) / (self.phi or 1.0))

    def lower_bound(self) -> float:
        """Bound on phi that the direction proves without trusting any solver [N]; infinite for a certificate."""
        problem = self.problem
        model = model_of(problem.contacts)
        velocities = np.einsum("iDk,D->ik", model.maps(problem.contacts, problem.reference_point), self.direction)
        capacity = float(model.support(velocities, problem.contacts.friction).sum())
        load = -float(self.direction @ problem.wrench)
        return load / capacity if capacity > 0 else (np.inf if load > 0 else 0.0)

    def gap(self) -> float:
        """phi / lower_bound - 1: how far the forces may be from the best."""
        bound = self.lower_bound()
        return self.phi / bound - 1 if bound > 0 and np.isfinite(self.phi) else 0.0
