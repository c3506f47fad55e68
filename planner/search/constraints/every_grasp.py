"""The conditions on every grasp, each made from the problem and the tree of its candidates: the one list.

To add one: write its file, in the words of `Constraint`, and name it here. The certificate must state it, and
`planner.verification` check it in code of its own; until then no proof that relies on it is called one.
"""

from collections.abc import Callable

from planner.search.constraints.constraint import Constraint
from planner.search.constraints.spacing import Spacing
from planner.search.problem import SearchProblem
from planner.search.regions.region_tree import RegionTree

EVERY_GRASP: list[Callable[[SearchProblem, RegionTree], Constraint]] = [Spacing]


def on_every_grasp(problem: SearchProblem, tree: RegionTree) -> list[Constraint]:
    """The conditions of a problem."""
    return [constraint(problem, tree) for constraint in EVERY_GRASP]
