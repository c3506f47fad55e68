"""Candidate contacts, each tied to the part and facet of the object it lies on."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from planner.arrays import Floats, Indices
from planner.contact_models.soft_finger import torsion_of_patch
from planner.contacts import ALLOWED_FRICTION, Contacts, possible_friction
from planner.errors import CandidateError, ContactError, RhograspError
from planner.files.source_file import SourceFile
from planner.objects.graspable import Graspable
from planner.objects.surface.coincident import parts_through
from planner.objects.surface.projection import project


@dataclass(frozen=True, kw_only=True)
class CandidateChoice:
    """What candidates were asked for, in the words of `grasp-plan`'s options: enough to choose the same ones again."""

    candidates: str
    """A number of points, `antipodal:NUMBER`, `grid:SPACING`, `case3`, or the path of a file of points or a grasp."""

    friction: float | None = None
    """Coulomb coefficient of all contacts; None for each geom's own."""

    friction_error: float = 0.0
    """By what share the coefficients may be smaller or larger; the contacts have the smallest."""

    fingertip: float | None = None
    """Radius of the ball that had to fit [m]; None for the usual share of the object's size."""

    seed: int = 0
    """Seed of points that are evenly spread or in opposed pairs."""

    torsion: float | None = None
    """Torsional friction of all contacts [m]; None for each geom's own, or that of a patch."""

    patch: float | None = None
    """Radius of the disc that every fingertip presses flat [m], of which the torsional friction follows; None where it
    does not."""

    file: SourceFile | None = None
    """The file of points, where they were listed in one."""

    confirmed: bool | None = None
    """Whether only those stayed that MuJoCo confirms; None where it is not known."""

    limited: bool | None = None
    """Whether only those stayed that limits allow, or distances or fingers were limited; None where not known."""

    limits: SourceFile | None = None
    """The file of these limits, where they came from one."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Candidates:
    """Points where a finger may touch an object."""

    contacts: Contacts
    """Points, inward normals, friction and torsional friction, in the body frame B."""

    part: Indices
    """Index into the object's parts, shape (n,)."""

    facet: Indices
    """Facet of that part, shape (n,)."""

    choice: CandidateChoice | None = None
    """What was asked for; None for candidates made in another way."""

    moved: float = 0.0
    """How far listed points were moved onto the surface, at most [m]."""

    friction_error: float = 0.0
    """By what share the coefficients may be smaller or larger; the contacts have the smallest."""

    planned_torsion: float = 0.0
    """The largest torsional friction that listed contacts of a grasp were planned with [m]; they need not have it."""

    def __len__(self) -> int:
        return len(self.part)

    def subset(self, indices: Indices) -> "Candidates":
        """The candidates at `indices`, shape (m,), in that order; why these is then the caller's own business."""
        return self.kept(indices, limited=None)

    def kept(self, indices: Indices, **how: Any) -> "Candidates":
        """The candidates at `indices`, shape (m,), which anyone can find again who knows how the choice says.

        Args:
            indices: Those that stay, in their order.
            how: Fields of `CandidateChoice` that say why.
        """
        left = replace(self, contacts=self.contacts.subset(indices), part=self.part[indices], facet=self.facet[indices])
        return left.chosen(**how)

    def twisting(self, torsion: float | None = None, patch: float | None = None) -> "Candidates":
        """The candidates with the torsional friction of the fingers, see `contacts_twisting`; their choice says so."""
        if torsion is None and patch is None:
            return self
        return replace(self, contacts=self.contacts_twisting(torsion, patch)).chosen(torsion=torsion, patch=patch)

    def contacts_twisting(self, torsion: float | None, patch: float | None) -> Contacts:
        """The contacts with the torsional friction of the fingers; as they are where neither is given.

        Args:
            torsion: gamma of every contact, less the friction error [m].
            patch: Or the radius a of the disc that every fingertip presses flat [m]: gamma = 2/3 mu a.

        Raises:
            CandidateError: If both are given, or one is negative, too large, or for a planar object.
        """
        require_one_torsion(torsion, patch, CandidateError)
        if torsion is not None:
            name, gamma = f"torsion {torsion:g}", np.full(len(self), torsion * (1 - self.friction_error))
        elif patch is not None:
            name, gamma = f"patch {patch:g}", torsion_of_patch(patch, self.contacts.friction)
        else:
            return self.contacts
        try:
            return replace(self.contacts, torsion=gamma if gamma.any() else None)
        except ContactError as error:
            raise CandidateError(f"{name} m: {error}") from error

    def least_friction(self, error: float) -> "Candidates":
        """The candidates with the smallest coefficients of an uncertain friction, mu (1 - error) and gamma (1 - error).

        A larger coefficient only widens the cones, so forces that hold here hold for every coefficient between
        mu (1 - error) and mu (1 + error), and rho of the worst of them is rho here.

        Args:
            error: Share by which each coefficient may be off, 0 or more and below 1.

        Raises:
            CandidateError: If the error is out of range.
        """
        if not 0 <= error < 1:
            raise CandidateError(
                f"the friction error is {error}; it is a share, 0 or more and below 1, for example 0.1"
            )
        contacts = self.contacts.with_friction(self.contacts.friction * (1 - error))
        return replace(self, contacts=contacts, friction_error=error).chosen(friction_error=error)

    def chosen(self, **how: Any) -> "Candidates":
        """The same candidates, with more known of how they were chosen.

        Args:
            how: Fields of `CandidateChoice`.
        """
        return self if self.choice is None else replace(self, choice=replace(self.choice, **how))


def require_one_torsion(torsion: float | None, patch: float | None, error: type[RhograspError]) -> None:
    """Refuse torsional friction said in two ways.

    Raises:
        RhograspError: Of the given kind, if both are given.
    """
    if torsion is not None and patch is not None:
        raise error(f"torsion {torsion:g} and patch {patch:g} both say how fingers resist turning; give one of them")


def candidates_at(
    rigid_object: Graspable, points: Floats, part: Indices, facet: Indices, friction: float | None
) -> Candidates:
    """Candidates at the surface points nearest to the given ones.

    Args:
        rigid_object: The object.
        points: Shape (n, d) [m].
        part: Part of each point, shape (n,).
        facet: Facet of each point, shape (n,).
        friction: Coulomb coefficient of all contacts; None takes each geom's own, and where several share the surface
            the smallest, because any of them may be what the finger touches. Torsional friction is each geom's own.

    Raises:
        CandidateError: If a friction coefficient is out of range.
    """
    feet, normals = project(rigid_object, points, part, facet)
    own, torsions = np.array([each.friction for each in rigid_object.parts]), rigid_object.torsions
    through = np.zeros((len(part), len(own)), dtype=bool)
    if friction is None or torsions.any():
        through = parts_through(rigid_object, feet)
    through[np.arange(len(part)), part] = True
    touched = part if friction is not None else np.where(through, own, np.inf).argmin(axis=1)
    mu = own[touched] if friction is None else np.full(len(part), float(friction))
    gamma = np.where(through, torsions, np.inf).min(axis=1) if torsions.any() else None
    bad = np.flatnonzero(~possible_friction(mu))
    if len(bad):
        source = "given" if friction is not None else f"of geom '{rigid_object.parts[touched[bad[0]]].geom}'"
        raise CandidateError(f"the friction {source} is {mu[bad[0]]:g}; it must be {ALLOWED_FRICTION}, set --friction")
    contacts = Contacts(points=feet, normals=normals, friction=mu, torsion=gamma)
    return Candidates(contacts=contacts, part=part, facet=facet)
