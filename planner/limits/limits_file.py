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
patch = 0.004                 # radius of the disc that it presses flat [m]; or torsion = 0.0013, or 0 for a hard finger
"""

from pathlib import Path

from planner.errors import LimitsError
from planner.files.toml_file import read_toml
from planner.limits.fit import require_fit
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable

SAMPLE = "; a whole limits file can be: span = 0.12  # greatest distance of two contacts in metres"
"""What ends a complaint about a limits file."""


def read_limits(path: Path | str, rigid_object: Graspable) -> Limits:
    """The limits of a file, for one object.

    Raises:
        LimitsError: If the file cannot be read, has an unknown key or a value that is not allowed, or does not fit
            the object.
    """
    limits = read_toml(Path(path), Limits, "limits file", LimitsError, sample=SAMPLE)
    try:
        require_fit(limits, rigid_object)
    except LimitsError as error:
        raise LimitsError(f"'{path}' is not a limits file for this object: {error}") from error
    return limits
