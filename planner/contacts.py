"""Contacts with friction and their grasp maps.

Frame: the object's body frame B, SI. A wrench is (force, moment), the moment taken about the reference
point p_o, in the axes of B. The plane is the case d = 2, D = 3 of the same formulas (space: d = 3, D = 6).
Source: Watanabe and Yoshikawa, eq. (1)-(3).
"""

from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Floats, Indices, Mask
from planner.errors import ContactError

UNIT_TOLERANCE = 1e-6
"""Largest accepted deviation of a normal's length from one."""

MOST_FRICTION = 1e3
"""Largest Coulomb coefficient. Its cone is within 0.06 degrees of a half-space, and no pair of materials comes near it.
The larger a coefficient, the fewer digits a cone program keeps: solvers agree to 5e-8 of rho here, to 2e-7 at 1e6, and
not at all at 1e9."""

ALLOWED_FRICTION = f"positive and at most {MOST_FRICTION:g}"

MOST_TORSION = 1e4
"""Largest torsional friction [m]: far beyond any object."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Contacts:
    """Point contacts with friction on the surface of a rigid object.

    Raises:
        ContactError: On shapes that do not match, values that are not finite, normals that are not unit
            vectors, friction or torsional friction out of range, or strength that is not positive.
    """

    points: Floats
    """Contact points, shape (contacts, d), d = 2 or 3 [m]."""

    normals: Floats
    """Inward unit normals, shape (contacts, d)."""

    friction: Floats
    """Coulomb coefficients, shape (contacts,)."""

    strength: Floats | None = None
    """See `strengths`; None where all fingers are of strength 1, shape (contacts,)."""

    torsion: Floats | None = None
    """See `torsions`; None where no finger resists turning, shape (contacts,)."""

    def __post_init__(self) -> None:
        if self.points.ndim != 2 or self.points.shape[1] not in (2, 3):
            raise ContactError(f"contact points have shape {self.points.shape}; expected (contacts, 2 or 3)")
        if self.normals.shape != self.points.shape or self.friction.shape != self.points.shape[:1]:
            raise ContactError(
                f"normals {self.normals.shape} and friction {self.friction.shape} "
                f"do not match points {self.points.shape}"
            )
        if not (np.isfinite(self.points).all() and np.isfinite(self.normals).all()):
            raise ContactError("a contact point or normal is not finite")
        if np.abs(np.linalg.norm(self.normals, axis=1) - 1).max(initial=0) > UNIT_TOLERANCE:
            raise ContactError("a contact normal is not a unit vector")
        if not possible_friction(self.friction).all():
            wrong = self.friction[~possible_friction(self.friction)][0]
            raise ContactError(f"a friction coefficient is {wrong:g}; it must be {ALLOWED_FRICTION}")
        if self.strengths.shape != self.friction.shape:
            raise ContactError(f"strengths {self.strengths.shape} do not match points {self.points.shape}")
        if not (np.isfinite(self.strengths) & (self.strengths > 0)).all():
            raise ContactError(f"a finger's strength must be positive and finite, got {self.strengths.min()}")

        self._check_torsion()

    def _check_torsion(self) -> None:
        if self.torsions.shape != self.friction.shape:
            raise ContactError(f"torsional friction {self.torsions.shape} does not match points {self.points.shape}")
        wrong = self.torsions[~((self.torsions >= 0) & (self.torsions <= MOST_TORSION))]  # NaN is wrong too
        if len(wrong):
            raise ContactError(
                f"a torsional friction is {wrong[0]:g} m; it is a length, 0 or more and at most {MOST_TORSION:g} m"
            )
        if self.dimension == 2 and self.torsions.any():
            raise ContactError("torsional friction resists turning about the normal, which is for objects in space")

    def __len__(self) -> int:
        return len(self.points)

    @property
    def dimension(self) -> int:
        """Dimension d of the space the object lives in: 2 or 3."""
        return int(self.points.shape[1])

    @property
    def strengths(self) -> Floats:
        """s_i: at the force level phi, the finger at contact i pushes with |f_i| <= s_i phi; shape (contacts,)."""
        return np.ones(len(self)) if self.strength is None else self.strength

    @property
    def torsions(self) -> Floats:
        """gamma_i: pushing with f_n and not rubbing, finger i holds torques up to gamma_i f_n about its normal.

        Shape (contacts,) [m]; 0 for a hard finger. See `planner.contact_models.soft_finger`.
        """
        return np.zeros(len(self)) if self.torsion is None else self.torsion

    def with_friction(self, friction: Floats) -> "Contacts":
        """The same patches on another pair of materials: gamma_i / mu_i, a length of the patch, stays.

        Args:
            friction: Coulomb coefficients, shape (contacts,).

        Raises:
            ContactError: When the friction is not one positive number per contact.
        """
        changed = replace(self, friction=friction)
        return changed if self.torsion is None else replace(changed, torsion=self.torsion * (friction / self.friction))

    def subset(self, indices: Indices) -> "Contacts":
        """The contacts at `indices`, shape (m,), in that order."""
        return Contacts(
            points=self.points[indices],
            normals=self.normals[indices],
            friction=self.friction[indices],
            strength=None if self.strength is None else self.strength[indices],
            torsion=None if self.torsion is None else self.torsion[indices],
        )


def possible_friction(friction: Floats) -> Mask:
    """Which coefficients can be planned with, a mask of the same shape."""
    return np.asarray((friction > 0) & (friction <= MOST_FRICTION))  # false for NaN


def reach(points: Floats, reference_point: Floats) -> float:
    """Largest distance of a point from p_o [m], 1 where all are at p_o: the length that compares moments with forces.

    Args:
        points: Shape (n, d) [m].
        reference_point: p_o, shape (d,) [m].
    """
    return float(np.linalg.norm(points - reference_point, axis=1).max()) or 1.0


def wrench_scale(dimension: int, length: float) -> Floats:
    """What makes the moments of a wrench comparable with its forces: 1 for forces, 1 / length for moments, shape (D,).

    Args:
        dimension: d, 2 or 3.
        length: See `reach` [m].
    """
    return np.append(np.ones(dimension), np.full(wrench_dimension(dimension) - dimension, 1 / length))


def wrench_dimension(dimension: int) -> int:
    """Dimension D of wrench space: 3 in the plane, 6 in space."""
    return 3 if dimension == 2 else 6


def grasp_maps(points: Floats, reference_point: Floats) -> Floats:
    """Grasp map G_i of each contact: a contact force f becomes the wrench G_i f = (f, (p_i - p_o) x f).

    Source: Watanabe and Yoshikawa, eq. (2).

    Args:
        points: Contact points p_i, shape (contacts, d) [m].
        reference_point: p_o, shape (d,) [m].

    Returns:
        Shape (contacts, D, d).
    """
    contacts, dimension = points.shape
    arms = points - reference_point
    maps = np.zeros((contacts, wrench_dimension(dimension), dimension))
    maps[:, :dimension] = np.eye(dimension)
    if dimension == 2:
        maps[:, 2, 0], maps[:, 2, 1] = -arms[:, 1], arms[:, 0]
    else:
        x, y, z = arms.T
        maps[:, 3, 1], maps[:, 3, 2] = -z, y
        maps[:, 4, 0], maps[:, 4, 2] = z, -x
        maps[:, 5, 0], maps[:, 5, 1] = -y, x
    return maps


def contact_frames(normals: Floats) -> Floats:
    """Rotation R_BC of each contact frame: columns are the inward normal and its tangents.

    Args:
        normals: Inward unit normals, shape (contacts, d).

    Returns:
        Shape (contacts, d, d).
    """
    if normals.shape[1] == 2:
        return np.stack([normals, np.stack([-normals[:, 1], normals[:, 0]], axis=1)], axis=2)
    least_aligned = np.eye(3)[np.abs(normals).argmin(axis=1)]
    first = np.cross(normals, least_aligned)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([normals, first, np.cross(normals, first)], axis=2)
