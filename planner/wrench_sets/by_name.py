"""The kinds of required external force set, by the name a task file gives them.

To add one: write its class in a file of its own, with the two methods of `WrenchSet`, and name it here.
"""

from planner.wrench_sets.ball import Ball
from planner.wrench_sets.box import Box
from planner.wrench_sets.cylinder import Cylinder
from planner.wrench_sets.ellipsoid import Ellipsoid
from planner.wrench_sets.polytope import Polytope
from planner.wrench_sets.single import Single
from planner.wrench_sets.wrench_set import WrenchSet

KINDS: dict[str, type[WrenchSet]] = {
    "ball": Ball,
    "box": Box,
    "cylinder": Cylinder,
    "ellipsoid": Ellipsoid,
    "polytope": Polytope,
    "single": Single,
}
