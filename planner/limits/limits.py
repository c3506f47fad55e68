"""The limits of a hand on one object, as a limits file states them.

Frame: the object's body frame B, SI; d = 3 in space, 2 in the plane. Which candidates they leave is decided in
`restricted` and `fingers`, one rule per file; `spacing`, `span` and the fingers' strengths are for the search.
"""

from math import inf

import msgspec
import numpy as np

from planner.arrays import Floats, Mask
from planner.candidates.candidates import require_one_torsion
from planner.contacts import MOST_TORSION
from planner.errors import LimitsError
from planner.objects.vectors import norm, unit
from planner.search.problem import MOST_FINGERS

LARGEST = 1e6
"""Largest accepted length [m] or ratio."""

DIMENSIONS = (2, 3)
"""Coordinates of a point: in the plane, in space."""

LEAST_NORMAL = 1e-6
"""Least length of a normal that says a direction; the greatest is LARGEST."""


class Zone(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The points with lower <= p <= upper in every coordinate; a side may be at infinity.

    Raises:
        LimitsError: On corners that do not match, are no numbers, or enclose nothing.
    """

    lower: tuple[float, ...]
    """Shape (d,) [m]."""

    upper: tuple[float, ...]
    """Shape (d,) [m]."""

    def __post_init__(self) -> None:
        lower, upper = _vector("lower", self.lower), _vector("upper", self.upper)
        if len(lower) != len(upper) or not (lower < upper).all():
            raise LimitsError(
                f"a box reaches from lower {list(self.lower)} to upper {list(self.upper)}; every coordinate of lower "
                "must be less than that of upper"
            )

    def holds(self, points: Floats) -> Mask:
        """Whether each point, shape (n, d) [m], lies in the box, shape (n,)."""
        return np.all((points >= self.lower) & (points <= self.upper), axis=1)


class Table(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The plane { p : up . p = height } that the object stands on.

    Raises:
        LimitsError: On a normal without direction, a height that is not finite, or a clearance that is not positive.
    """

    normal: tuple[float, ...]
    """Away from the table, of any length, shape (d,)."""

    clearance: float
    """Contacts are at least this far above [m]; positive, so that none is on the underside."""

    height: float | None = None
    """Along the unit normal [m]; the lowest point of the object where left out."""

    def __post_init__(self) -> None:
        length = norm(_vector("table.normal", self.normal))
        if not LEAST_NORMAL <= length <= LARGEST:
            raise LimitsError(
                f"table.normal is {list(self.normal)}; its length must be between {LEAST_NORMAL:g} and {LARGEST:g}"
            )
        if self.height is not None and not abs(self.height) <= LARGEST:
            raise LimitsError(f"table.height is {self.height}; it must be finite, at most {LARGEST:g} m in magnitude")
        _positive("table.clearance", self.clearance)

    @property
    def up(self) -> Floats:
        """The unit normal, shape (d,)."""
        return unit(np.array(self.normal, dtype=float))


class Approach(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The straight way by which a fingertip, a ball, comes to its contact along the inward normal.

    Raises:
        LimitsError: On a radius or length that is not positive.
    """

    radius: float
    """Of the fingertip [m]."""

    length: float
    """How far the fingertip comes [m]."""

    def __post_init__(self) -> None:
        _positive("approach.radius", self.radius)
        _positive("approach.length", self.length)


class Finger(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What one finger can do.

    Raises:
        LimitsError: On a strength that is not positive, a list of geoms that is empty, or torsional friction that is
            negative or said in two ways.
    """

    strength: float = 1.0
    """s: the finger pushes with |f| <= s rho."""

    geoms: tuple[str, ...] | None = None
    """The geoms it may touch, by name or pattern ("wall*"); all where left out."""

    within: Zone | None = None
    """Where it may touch; anywhere where left out."""

    torsion: float | None = None
    """Its torsional friction [m], 0 for a hard finger; where neither this nor a patch is given, the candidates'."""

    patch: float | None = None
    """Or the radius of the disc that it presses flat [m]."""

    @property
    def twist_is_said(self) -> bool:
        """Whether it says how the finger resists turning."""
        return self.torsion is not None or self.patch is not None

    def __post_init__(self) -> None:
        _positive("a finger's strength", self.strength)
        require_one_torsion(self.torsion, self.patch, LimitsError)
        for name, length in (("torsion", self.torsion), ("patch", self.patch)):
            if length is not None and not 0 <= length <= MOST_TORSION:
                raise LimitsError(
                    f"a finger's {name} is {length}; it is a length, 0 or more and at most {MOST_TORSION:g} m"
                )
        if self.geoms is not None and not self.geoms:
            raise LimitsError("a finger's geoms are an empty list; leave geoms out to allow every geom")


class Limits(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Everything that a limits file can say; what is left out limits nothing.

    Raises:
        LimitsError: On distances that are out of range or leave no room, or too many fingers.
    """

    spacing: float = 0.0
    """Least distance between two contacts [m]."""

    span: float = inf
    """Greatest distance between two contacts [m]."""

    exclude_geoms: tuple[str, ...] = ()
    """Geoms that no finger may touch, by name or pattern ("handle*")."""

    keep_out: tuple[Zone, ...] = ()
    """Boxes in which no contact may lie."""

    table: Table | None = None

    approach: Approach | None = None

    fingers: tuple[Finger, ...] = msgspec.field(default=(), name="finger")
    """One for every finger, or none where all fingers are alike."""

    def __post_init__(self) -> None:
        if not 0 <= self.spacing <= LARGEST:
            raise LimitsError(f"spacing is {self.spacing}; it must not be negative, and at most {LARGEST:g} m")
        if not self.spacing <= self.span or self.span == 0:
            raise LimitsError(
                f"span is {self.span}; the greatest distance between two contacts must be positive and not less than "
                f"the least, spacing = {self.spacing:g} m"
            )
        if len(self.fingers) > MOST_FINGERS:
            raise LimitsError(f"there are {len(self.fingers)} tables [[finger]]; at most {MOST_FINGERS} are allowed")

    @property
    def strengths(self) -> Floats:
        """Relative strength of every finger, shape (fingers,)."""
        return np.array([finger.strength for finger in self.fingers])


def _positive(name: str, value: float) -> float:
    """A positive finite number.

    Raises:
        LimitsError: On any other number.
    """
    if not 0 < value <= LARGEST:
        raise LimitsError(f"{name} is {value}; it must be positive and at most {LARGEST:g}")
    return value


def _vector(name: str, values: tuple[float, ...]) -> Floats:
    """Two or three numbers, infinite ones included, as an array.

    Raises:
        LimitsError: On another count, or on what is no number.
    """
    array = np.array(values, dtype=float)
    if len(array) not in DIMENSIONS:
        raise LimitsError(f"{name} has {len(array)} numbers; it must have 3, or 2 for a planar object")
    if np.isnan(array).any():
        raise LimitsError(f"{name} is {list(values)}; every coordinate must be a number")
    return array
