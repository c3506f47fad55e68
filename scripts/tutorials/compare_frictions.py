"""Compare frictions: is a rubber pad worth it?

The friction coefficient decides how far a contact force may lean from the normal. Rougher fingertips lean further, so
they need less force for the same task: rho never grows with friction. How much it falls, and whether the best contacts
move, is not obvious; this plans for each coefficient, with a proof each time, and prints the ratio.

The last column answers another question: what does a grasp planned for the first, slippery fingertips need once the
pads are on? It is never less than the best grasp for those pads.

    python scripts/tutorials/compare_frictions.py
"""

from pathlib import Path

from planner import GraspProblem, make_candidates, make_task, plan, read_object
from planner.search.evaluation import Evaluator
from planner.search.problem import SearchProblem

PRISM = Path(__file__).resolve().parents[2] / "assets" / "prism" / "prism.xml"
FRICTIONS = 0.2, 0.3, 0.5, 0.8


def main() -> None:
    """Print rho and the chosen candidates for each coefficient."""
    prism = read_object(PRISM)
    task = make_task("paper", prism)
    first = None
    print(f"{'friction':>8} {'rho [N]':>8} {'candidates':>12} {'first grasp [N]':>16}")
    for friction in FRICTIONS:
        candidates = make_candidates(prism, "60", friction, seed=0)  # the same points, another coefficient
        grasp = plan(GraspProblem(prism, task, candidates, fingers=3))
        first = grasp.chosen if first is None else first
        problem = SearchProblem(
            contacts=candidates.contacts, fingers=3, reference_point=task.reference_point, wrenches=task.wrenches
        )
        kept = Evaluator(problem).evaluate(first).rho
        chosen = " ".join(map(str, grasp.chosen.tolist()))
        print(f"{friction:8.2f} {grasp.rho:8.4f} {chosen:>12} {kept:16.4f}")


if __name__ == "__main__":
    main()
