"""Reads limits from a TOML file; every key may be left out:

spacing = 0.015               # least distance between two contacts [m]: the width of a finger
span = 0.12                   # greatest [m]: the opening of the hand
exclude_geoms = ["handle*"]   # no finger on these geoms; * stands for any characters

[[keep_out]]                  # no contact in this box of the body frame [m]; inf is allowed
lower = [-inf, -inf, 0.08]
upper = [inf, inf, inf]

[table]                       # the object stands on a plane
normal = [0, 0, 1]            # up, body frame
height = 0.0                  # along the normal [m]; the lowest point of the object where left out
clearance = 0.008             # contacts are at least this far above [m]

[approach]                    # a fingertip comes straight along the normal, past all parts and above the table
radius = 0.008                # of the fingertip [m]
length = 0.06                 # of its way [m]

[[finger]]                    # one table for every finger, or none
strength = 1.0                # |f| <= strength rho
geoms = ["wall*"]             # only on these geoms
within = {lower = [0, -1, -1], upper = [1, 1, 1]}  # only in this box [m]
"""

import tomllib
from pathlib import Path

import msgspec

from planner.errors import LimitsError
from planner.limits.fit import require_fit
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable

MAX_FILE_BYTES = 1_000_000
"""Largest limits file: room for thousands of boxes."""


def read_limits(path: Path, rigid_object: Graspable) -> Limits:
    """The limits of a file, for one object.

    Raises:
        LimitsError: If the file cannot be read, has an unknown key or a value that is not allowed, or does not fit
            the object.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(MAX_FILE_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a path that no file can have
        raise LimitsError(f"the limits file '{path}' cannot be read: {error}") from error
    if len(content) > MAX_FILE_BYTES:
        raise LimitsError(f"limits file {path} is longer than {MAX_FILE_BYTES} bytes")
    try:
        limits = msgspec.convert(tomllib.loads(content.decode()), Limits)
        require_fit(limits, rigid_object)
    except (LimitsError, ValueError, RecursionError, msgspec.ValidationError) as error:  # ValueError: TOML and UTF-8
        raise LimitsError(f"limits file {path}: {error}") from error
    return limits
