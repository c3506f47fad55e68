"""Candidate contacts, each tied to the part and facet of the object it lies on."""

from dataclasses import dataclass

import numpy as np

from planner.contacts import Contacts
from planner.errors import CandidateError
from planner.objects.graspable import Graspable
from planner.objects.projection import project


@dataclass(frozen=True, eq=False, kw_only=True)
class Candidates:
    """Points where a finger may touch an object."""

    contacts: Contacts
    """Points, inward normals and friction, in the body frame B."""

    part: np.ndarray
    """Index into the object's parts, shape (n,)."""

    facet: np.ndarray
    """Facet of that part, shape (n,)."""

    def __len__(self) -> int:
        return len(self.part)

    def subset(self, indices: np.ndarray) -> "Candidates":
        """The candidates at `indices`, shape (m,), in that order."""
        return Candidates(contacts=self.contacts.subset(indices), part=self.part[indices], facet=self.facet[indices])


def candidates_at(
    rigid_object: Graspable, points: np.ndarray, part: np.ndarray, facet: np.ndarray, friction: float | None
) -> Candidates:
    """Candidates at the surface points nearest to the given ones.

    Args:
        rigid_object: The object.
        points: Shape (n, d) [m].
        part: Part of each point, shape (n,).
        facet: Facet of each point, shape (n,).
        friction: Coulomb coefficient of all contacts; None takes each geom's own.

    Raises:
        CandidateError: If a friction coefficient is not positive and finite.
    """
    own = np.array([each.friction for each in rigid_object.parts])
    mu = own[part] if friction is None else np.full(len(part), float(friction))
    bad = np.flatnonzero(~(np.isfinite(mu) & (mu > 0)))
    if len(bad):
        source = "given" if friction is not None else f"of geom '{rigid_object.parts[part[bad[0]]].geom}'"
        raise CandidateError(f"the friction {source} is {mu[bad[0]]}; it must be positive and finite, set --friction")
    feet, normals = project(rigid_object, points, part, facet)
    return Candidates(contacts=Contacts(points=feet, normals=normals, friction=mu), part=part, facet=facet)
