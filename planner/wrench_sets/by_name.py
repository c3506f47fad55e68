"""The kinds of required external force set, by the name a task file gives them.

To add one: write its class in a file of its own, with the two methods of `WrenchSet`, and name it here.
"""

from planner.wrench_sets.ball import WrenchBall
from planner.wrench_sets.box import WrenchBox
from planner.wrench_sets.cylinder import WrenchCylinder
from planner.wrench_sets.ellipsoid import WrenchEllipsoid
from planner.wrench_sets.polytope import WrenchPolytope
from planner.wrench_sets.single import SingleWrench
from planner.wrench_sets.wrench_set import WrenchSet

KINDS: dict[str, type[WrenchSet]] = {
    "ball": WrenchBall,
    "box": WrenchBox,
    "cylinder": WrenchCylinder,
    "ellipsoid": WrenchEllipsoid,
    "polytope": WrenchPolytope,
    "single": SingleWrench,
}
