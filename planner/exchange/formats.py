"""Which file ending means which format: the one list.

To add a format: write its module with `write_fingertips`, and `write_hand` if it can hold a hand's grasp, and name it
here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from planner.errors import OutputError
from planner.exchange import dexgraspbench, glb, graspgen, isaac_grasp
from planner.exchange.hand_grasp import HandGrasp
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable


@dataclass(frozen=True, kw_only=True)
class Format:
    """A file format and what can be written in it."""

    ending: str
    """Of the file's name, lower case."""

    fingertips: Callable[[Path, Graspable, Grasp, int | None], None]
    """Writes a planned grasp with the forces for one wrench, or says why that cannot be."""

    hand: Callable[[Path, HandGrasp], None] | None = None
    """Writes the grasp of a hand."""


FORMATS = (
    Format(ending=".glb", fingertips=glb.write_glb),
    Format(ending=".isaac.yaml", fingertips=isaac_grasp.write_fingertips, hand=isaac_grasp.write_hand),
    Format(ending=".yaml", fingertips=isaac_grasp.write_fingertips, hand=isaac_grasp.write_hand),
    Format(ending=".graspgen.json", fingertips=graspgen.write_fingertips, hand=graspgen.write_hand),
    Format(ending=".npy", fingertips=dexgraspbench.write_fingertips),
)


def format_of(path: Path) -> Format:
    """The format that a file's name asks for.

    Raises:
        OutputError: When no format has this ending.
    """
    for format in FORMATS:
        if path.name.lower().endswith(format.ending):
            return format
    endings = ", ".join(format.ending for format in FORMATS)
    raise OutputError(f"cannot convert to {path.suffix or path}; the output must end in {endings}")
