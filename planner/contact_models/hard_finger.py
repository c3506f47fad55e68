"""The hard finger: a point that pushes and rubs, and cannot twist.

    x = (f_n, f_t) in R^d,        K = { f : |f_t| <= mu f_n },        G_i f = (f, (p_i - p_o) x f)

so k = d and no component needs scaling. Source: Watanabe and Yoshikawa, eq. (1)-(3).
"""

from math import hypot, sqrt

import numpy as np

from planner.arrays import Floats
from planner.contact_models import friction_cone
from planner.contact_models.contact_model import ContactModel
from planner.contacts import Contacts, contact_frames, grasp_maps


class HardFinger(ContactModel):
    """Coulomb friction at a point; see `ContactModel`."""

    condim = 3

    def components(self, dimension: int) -> int:
        """k = d."""
        return dimension

    def maps(self, contacts: Contacts, reference_point: Floats) -> Floats:
        """G_i R_i s_i, shape (n, D, d)."""
        maps = grasp_maps(contacts.points, reference_point) @ contact_frames(contacts.normals)
        return np.ascontiguousarray(maps * contacts.strengths[:, None, None])

    def forces(self, contacts: Contacts, components: Floats) -> Floats:
        """R_i s_i x_i, shape (..., m, d) [N]."""
        frames = contact_frames(contacts.normals) * contacts.strengths[:, None, None]
        return np.einsum("ide,...ie->...id", frames, components)

    def torques(self, contacts: Contacts, components: Floats) -> Floats:
        """None, shape (..., m)."""
        return np.zeros(components.shape[:-1])

    def support(self, velocities: Floats, friction: Floats) -> Floats:
        """|Proj_K(v)|, shape (...)."""
        return friction_cone.support(velocities, np.eye(velocities.shape[-1])[0], friction)

    @staticmethod
    def capacities(maps: Floats, friction: Floats, direction: Floats, values: Floats) -> None:
        """See `ContactModel.capacities`; `support` is its slow twin."""
        count, size, components = maps.shape
        for i in range(count):
            along = square = 0.0
            for axis in range(components):
                pull = 0.0
                for row in range(size):
                    pull += maps[i, row, axis] * direction[row]
                if axis == 0:
                    along = pull
                else:
                    square += pull * pull
            across = sqrt(square)
            if across <= friction[i] * along:
                values[i] = hypot(along, across)
            else:
                values[i] = max(0.0, (along + friction[i] * across) / sqrt(1 + friction[i] * friction[i]))

    def excess(self, forces: Floats, torques: Floats, contacts: Contacts) -> Floats:
        """max(|f_t| - mu f_n, -f_n), shape (..., m) [N]; there are no torques."""
        along, across = friction_cone.components(forces, contacts.normals)
        return np.maximum(across - contacts.friction * along, -along)

    def utilisation(self, forces: Floats, torques: Floats, contacts: Contacts) -> Floats:
        """|f_t| / f_n, shape (..., m); there are no torques."""
        return friction_cone.utilisation(forces, contacts.normals)

    def pair_friction(self, friction: float, torsion: float) -> tuple[float, float, float, float, float]:
        """Sliding alone."""
        return friction, friction, 0.0, 0.0, 0.0


HARD_FINGER = HardFinger()
