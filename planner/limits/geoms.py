"""No finger on excluded geoms."""

from fnmatch import fnmatchcase

import numpy as np

from planner.arrays import Mask
from planner.candidates.candidates import Candidates
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable
from planner.objects.surface.coincident import parts_through


def off_excluded_geoms(rigid_object: Graspable, candidates: Candidates, limits: Limits) -> Mask:
    """Whether each candidate lies on a geom that is not excluded, shape (n,)."""
    return ~on_geoms(rigid_object, candidates, limits.exclude_geoms)


def on_geoms(rigid_object: Graspable, candidates: Candidates, patterns: tuple[str, ...]) -> Mask:
    """Whether a geom on whose surface each candidate lies matches one of the names or patterns, shape (n,)."""
    named = np.array([any(matches(part.geom, pattern) for pattern in patterns) for part in rigid_object.parts])
    return named[candidates.part] | parts_through(rigid_object, candidates.contacts.points)[:, named].any(axis=1)


def matches(geom: str, pattern: str) -> bool:
    """Whether a geom is meant: by its name, or by a pattern in which * stands for any characters."""
    return geom == pattern or fnmatchcase(geom, pattern)
