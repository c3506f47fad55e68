"""What the planner, the checker and the simulator ask of a contact model.

A finger at contact i pushes with x in R^k, in its contact frame, divided by its strength, the normal component first
and scaled so that its friction cone is round. With d the dimension of space, and k not less than d,

    K = { x : |(x_2, ..., x_k)| <= mu x_1 },      |(x_1, ..., x_d)| <= phi,      wrench = G_i x.

So the inner problem is the same cone program for every model, of another size; a model says what G_i is, and what its
components mean. d is not k: a finger that can twist has one component more than space has axes.
"""

from abc import ABC, abstractmethod
from typing import ClassVar

from planner.arrays import Floats
from planner.contacts import Contacts


class ContactModel(ABC):
    """One way to touch."""

    condim: ClassVar[int]
    """MuJoCo's name for it: dimensions of the contact space."""

    @abstractmethod
    def components(self, dimension: int) -> int:
        """k in a space of dimension d."""

    @abstractmethod
    def maps(self, contacts: Contacts, reference_point: Floats) -> Floats:
        """G_i from components over strengths to wrenches about p_o, shape (n, D, k)."""

    @abstractmethod
    def forces(self, contacts: Contacts, components: Floats) -> Floats:
        """Forces in the body frame, shape (..., m, d) [N], of components over strengths, shape (..., m, k) [N]."""

    @abstractmethod
    def torques(self, contacts: Contacts, components: Floats) -> Floats:
        """Torques about the inward normals, shape (..., m) [N m], of components as in `forces`."""

    @abstractmethod
    def support(self, velocities: Floats, friction: Floats) -> Floats:
        """h(v) = max { v.x : x in K, |(x_1, ..., x_d)| <= 1 }, shape (...).

        Args:
            velocities: v = G' lambda, shape (..., k).
            friction: mu, broadcastable to shape (...).
        """

    @staticmethod
    @abstractmethod
    def capacities(maps: Floats, friction: Floats, direction: Floats, values: Floats) -> None:
        """The same for G_i' lambda of many contacts in plain loops, written into `values`: the search compiles it.

        Args:
            maps: G_i, shape (n, D, k).
            friction: Shape (n,).
            direction: lambda, shape (D,).
            values: h_i(lambda), set in place, shape (n,).
        """

    @abstractmethod
    def excess(self, forces: Floats, torques: Floats, contacts: Contacts) -> Floats:
        """How far each force and torque lie outside their friction cone, negative inside, shape (..., m) [N].

        Args:
            forces: In the body frame, shape (..., m, d) [N].
            torques: About the inward normals, shape (..., m) [N m].
            contacts: Where they act.
        """

    @abstractmethod
    def utilisation(self, forces: Floats, torques: Floats, contacts: Contacts) -> Floats:
        """The smallest mu whose cone holds each force and torque, all friction of the contact in proportion.

        Its ratio to the contact's own mu is the share of friction that they take: above 1 outside the cone.

        Args:
            forces: In the body frame, shape (..., m, d) [N].
            torques: About the inward normals, shape (..., m) [N m].
            contacts: Where they act.

        Returns:
            Shape (..., m); infinite where a force pulls, zero where it vanishes.
        """

    @abstractmethod
    def pair_friction(self, friction: float, torsion: float) -> tuple[float, float, float, float, float]:
        """The friction of MuJoCo's contact pair: sliding twice, torsion [m], rolling twice."""
