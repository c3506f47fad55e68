"""Design a task: say what the grasp must resist.

A task is a set of wrenches (f, m): forces on the object, and moments about a reference point. The grasp must resist
every one of them, so the worst decides. A set is convex; its vertices are enough. Two ways to make one:

- a shape: `cylinder` with force F and moment M is all forces up to F from any side, together with all moments up to M;
- a `polytope`: the wrenches you can name. Pouring from a bottle turns the weight from upright to tipped, while the
  liquid runs to one side. Name both ends and what lies between is covered too, but mind a curved path: the weight
  turns on a circle, which lies outside the straight line between its ends. The corner (-W, -W) encloses the arc.

A larger set never needs less force: asking only for what the job needs is what makes fingers small.

    python scripts/tutorials/design_a_task.py
"""

import tempfile
from pathlib import Path

from planner import GraspProblem, make_candidates, make_task, plan, read_object

ASSETS = Path(__file__).resolve().parents[2] / "assets"

POUR = """
name = "pour"
[set]
kind = "polytope"
wrenches = [                                   # [N, N, N, N m, N m, N m]
    [ 0, 0, -5, 0, -0.02, 0], [ 0, 0, -5, 0, 0.02, 0],   # upright
    [-5, 0, -5, 0, -0.02, 0], [-5, 0, -5, 0, 0.02, 0],   # the corner that encloses the arc
    [-5, 0,  0, 0, -0.02, 0], [-5, 0,  0, 0, 0.02, 0],   # tipped
]
"""

ANY_DIRECTION = """
name = "pour in any direction"
[set]
kind = "cylinder"
force = 7.0711     # the longest force above ...
moment = 0.02      # ... and the largest moment, each from any side
"""


def main() -> None:
    """Plan the same object for both tasks and name the wrench that hurts most."""
    bottle = read_object(ASSETS / "cylinder" / "cylinder.xml")
    candidates = make_candidates(bottle, "60", friction=0.6, seed=0)
    with tempfile.TemporaryDirectory() as folder:
        for number, text in enumerate((POUR, ANY_DIRECTION)):
            file = Path(folder) / f"{number}.toml"
            file.write_text(text)
            task = make_task(str(file), bottle)
            grasp = plan(GraspProblem(bottle, task, candidates, fingers=3))
            worst = ", ".join(f"{value:.3g}" for value in task.wrenches[grasp.critical_wrench])
            print(f"{task.name:22s} {len(task.wrenches):4d} wrenches  rho {grasp.rho:7.3f} N  worst ({worst})")


if __name__ == "__main__":
    main()
