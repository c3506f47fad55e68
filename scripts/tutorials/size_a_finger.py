"""Size a finger: how strong must an actuator be, and what can it carry?

rho is a force in newtons: the least that every finger must be able to push so that the whole task is resisted. Two
facts make it a number to design with. It is proven, so no cleverer placement among the candidates saves force. And it
is proportional to the load: twice the task, twice rho. So an actuator that pushes F carries F / rho times the task.

More fingers share the load, but not freely: the gain from three to five is what this prints. The last step asks
MuJoCo whether the choice is true: every wrench must hold with the cap just above rho, and slip just below.

    python scripts/tutorials/size_a_finger.py
"""

from pathlib import Path

from planner import GraspProblem, make_candidates, make_task, plan, read_object
from sim import validate

BOX = Path(__file__).resolve().parents[2] / "assets" / "box" / "box.xml"
ACTUATOR = 10.0
"""What one finger of the catalogue can push [N]."""


def main() -> None:
    """Print what the actuator carries with three to five fingers, and let MuJoCo judge the last grasp."""
    box = read_object(BOX)
    task = make_task("gravity", box)
    candidates = make_candidates(box, "40", friction=0.5, seed=0)
    for fingers in (3, 4, 5):
        grasp = plan(GraspProblem(box, task, candidates, fingers))
        payload = box.mass * ACTUATOR / grasp.rho
        print(
            f"{fingers} fingers: rho {grasp.rho:.3f} N; {ACTUATOR:g} N per finger carry {payload:.2f} kg of this shape"
        )
    print(f"MuJoCo says {validate(box, grasp).verdict}")


if __name__ == "__main__":
    main()
