"""The soft finger: a patch that pushes, rubs and twists, as the textbooks idealise it.

    f in R^3 and the torque tau about the inward normal n,
    K = { (f, tau) : |f_t|^2 / mu^2 + tau^2 / gamma^2 <= f_n^2, f_n >= 0 },      wrench = G_i f + (0, tau n)

The ellipsoid is the usual approximation of a patch's limit surface, and the cap is on the force alone. gamma, the
torsional friction, is a length: for a patch with pressure p it is mu times the mean distance of the pressure from the
patch's centre,

    even pressure on a disc of radius a             2/3 mu a
    Hertz's pressure on a disc of radius a          3 pi / 16 mu a = 0.589 mu a
    even pressure on a square of half side a        0.765 mu a
    the rim of a disc, four corners at distance a   mu a

With tau' = tau mu / gamma the cone is round, x = (f_n, f_t, tau') in R^4; a finger without torsional friction is the
case gamma = 0, whose tau' does nothing. MuJoCo's elliptic cone of `condim` 4 with pair friction (mu, mu, gamma) is this
one. Source: R. D. Howe, M. R. Cutkosky, "Practical force-motion models for sliding manipulation", 1996; MuJoCo's
documentation, "Contact".
"""

from math import hypot, sqrt

import numpy as np

from planner.arrays import Floats
from planner.contact_models import friction_cone
from planner.contact_models.contact_model import ContactModel
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contacts import Contacts

EVEN_DISC = 2 / 3
"""gamma / (mu a) for even pressure on a disc of radius a."""

STEPS = 60
"""Bound on Newton's steps, of which it takes three to six; bisection in their place would be as exact by then."""

CLOSE = 1e-13
"""Accuracy of q, relative to b."""


def torsion_of_patch(radius: float, friction: Floats) -> Floats:
    """gamma = 2/3 mu a of a disc that presses evenly, shape of `friction` [m].

    Args:
        radius: a [m].
        friction: mu.
    """
    return EVEN_DISC * radius * friction


class SoftFinger(ContactModel):
    """Coulomb friction and torsional friction in one cone; see `ContactModel`. In space only.

    Its support function is a minimum over one number, by the duality of cones: with a = v_1, b = |(v_2, v_3)| and
    c = |v_4|,

        h(v) = min over 0 <= q <= b of H(q),      H(q) = hypot( max(0, a + mu hypot(b - q, c)), q ).

    Every q gives an H(q) that is h or more, so a bound made of it is true however badly q is chosen. H^2 is convex.
    """

    condim = 4

    def components(self, dimension: int) -> int:
        """k = 4."""
        return dimension + 1

    def maps(self, contacts: Contacts, reference_point: Floats) -> Floats:
        """(G_i R_i, (0, n) gamma / mu) s_i, shape (n, 6, 4)."""
        maps = np.zeros((len(contacts), 6, 4))
        maps[:, :, :3] = HARD_FINGER.maps(contacts, reference_point)
        maps[:, 3:, 3] = _twist(contacts)[:, None] * contacts.normals
        return maps

    def forces(self, contacts: Contacts, components: Floats) -> Floats:
        """R_i s_i (x_1, x_2, x_3), shape (..., m, 3) [N]."""
        return HARD_FINGER.forces(contacts, components[..., :3])

    def torques(self, contacts: Contacts, components: Floats) -> Floats:
        """s_i x_4 gamma / mu, shape (..., m) [N m]."""
        return components[..., 3] * _twist(contacts)

    def support(self, velocities: Floats, friction: Floats) -> Floats:
        """H at its minimum, shape (...): the root of H H' = p p' + q, p the normal part of H, by safeguarded Newton."""
        along, across = velocities[..., 0], np.hypot(velocities[..., 1], velocities[..., 2])
        turning, friction = np.abs(velocities[..., 3]), np.broadcast_to(friction, along.shape)
        lower, upper = np.zeros_like(across), across.copy()
        q = np.clip(friction * (along + friction * across) / (1 + friction * friction), lower, upper)
        for _ in range(STEPS):
            rest = across - q
            arm = np.maximum(np.hypot(rest, turning), np.finfo(float).tiny)
            p, slope = along + friction * arm, -friction * rest / arm
            value = np.where(p > 0, p * slope + q, q)
            lower, upper = np.where(value < 0, q, lower), np.where(value < 0, upper, q)
            step = q - value / (slope * slope + np.maximum(p, 0) * friction * (turning / arm) ** 2 / arm + 1)
            following = np.where((step > lower) & (step < upper), step, (lower + upper) / 2)
            moved, q = np.abs(following - q), following
            if (moved <= CLOSE * across).all():
                break
        return np.hypot(np.maximum(along + friction * np.hypot(across - q, turning), 0), q)

    @staticmethod
    def capacities(maps: Floats, friction: Floats, direction: Floats, values: Floats) -> None:
        """See `ContactModel.capacities`; `support` is its slow twin."""
        count, size, components = maps.shape
        for i in range(count):
            mu, along, square, turning = friction[i], 0.0, 0.0, 0.0
            for axis in range(components):
                pull = 0.0
                for row in range(size):
                    pull += maps[i, row, axis] * direction[row]
                if axis == 0:
                    along = pull
                elif axis == 3:
                    turning = abs(pull)
                else:
                    square += pull * pull
            across = sqrt(square)
            if along + mu * hypot(across, turning) <= 0:
                values[i] = 0.0
                continue
            q = min(max(mu * (along + mu * across) / (1 + mu * mu), 0.0), across)
            if turning > 0:
                lower, upper = 0.0, across
                for _ in range(STEPS):
                    rest = across - q
                    arm = hypot(rest, turning)
                    p = along + mu * arm
                    slope = -mu * rest / arm
                    value = p * slope + q if p > 0 else q
                    if value < 0:
                        lower = q
                    else:
                        upper = q
                    following = q - value / (slope * slope + max(p, 0.0) * mu * (turning / arm) ** 2 / arm + 1)
                    if not lower < following < upper:
                        following = (lower + upper) / 2
                    moved = abs(following - q)
                    q = following
                    if moved <= CLOSE * across:
                        break
            values[i] = hypot(max(along + mu * hypot(across - q, turning), 0.0), q)

    def excess(self, forces: Floats, torques: Floats, contacts: Contacts) -> Floats:
        """max(|(f_t, tau mu / gamma)| - mu f_n, -f_n), shape (..., m) [N]; infinite for a torque where gamma is 0."""
        along, across = friction_cone.components(forces, contacts.normals)
        return np.maximum(np.hypot(across, rubbing(torques, contacts)) - contacts.friction * along, -along)

    def utilisation(self, forces: Floats, torques: Floats, contacts: Contacts) -> Floats:
        """|(f_t, tau mu / gamma)| / f_n, shape (..., m); infinite for a torque where gamma is 0."""
        along, across = friction_cone.components(forces, contacts.normals)
        return friction_cone.slope(along, np.hypot(across, rubbing(torques, contacts)))

    def pair_friction(self, friction: float, torsion: float) -> tuple[float, float, float, float, float]:
        """Sliding and torsion."""
        return friction, friction, torsion, 0.0, 0.0


def rubbing(torques: Floats, contacts: Contacts) -> Floats:
    """tau' = |tau| mu / gamma: the tangential force that uses as much of the cone, shape of `torques` [N].

    Infinite for a torque at a contact without torsional friction.

    Args:
        torques: About the inward normals, shape (..., m) [N m].
        contacts: Where they act, m of them.
    """
    size = np.abs(torques)
    equal = np.where(size > 0, np.inf, 0.0)
    soft = np.broadcast_to(contacts.torsions > 0, size.shape)
    return np.divide(size * contacts.friction, contacts.torsions, out=equal, where=soft)


def _twist(contacts: Contacts) -> Floats:
    """s_i gamma / mu, shape (n,) [m]."""
    return contacts.strengths * contacts.torsions / contacts.friction


SOFT_FINGER = SoftFinger()
