"""Size a parallel jaw: how hard must it close, how large must its pads be, and of what?

Two fingers that touch in points hold nothing that comes from all sides: a moment about the line through both contacts
turns the object between them, however hard they press. A pad resists it by torsional friction, up to gamma = 2/3 mu a
per newton where it presses evenly on a disc of radius a. Its torque and its rubbing share one cone,

    (rubbing / mu)^2 + (torque / gamma)^2 <= (normal force)^2,

so a jaw has three numbers to choose: the force it closes with, the radius of its pads, and their friction. This prints
the first for a table of the other two, each proven to be the least for the object's weight in any direction: for a box,
for a bottle (a cylinder), and for a tool that is held by its grip, the heavy head beyond.

What it teaches. Larger pads never need more force. While they are small, twice the pad is half the force; rougher pads
gain as much, or more, because friction also opens better places. Once pads are large they only press and rub, and the
last column says how far they can help at all: from there on it is friction or nothing. And no pad makes up for a bad
place: with friction 0.5 the box and the bottle ask for twice their weight, the tool, whose head is no place for a jaw,
for three times its own.

A disc of 8 mm is a promise: on a bottle only a pad that yields keeps it. Plan with what really touches.

    python scripts/tutorials/size_a_jaw.py
"""

import tempfile
from math import inf
from pathlib import Path

from planner import GraspProblem, make_candidates, make_task, plan, read_object
from planner.grasps.grasp import Grasp
from planner.limits.limits import Limits
from planner.objects.graspable import Graspable

ASSETS = Path(__file__).resolve().parents[2] / "assets"

TOOL = """
<mujoco model="tool">
  <worldbody>
    <body name="tool">
      <freejoint/>
      <geom name="grip" type="box" size="0.012 0.012 0.06" density="700"/>
      <geom name="head" type="box" size="0.03 0.012 0.012" pos="0 0 0.072" density="7800"/>
    </body>
  </worldbody>
</mujoco>
"""

OPENING = 0.085
"""The most that the jaw opens [m]."""

CLOSING = 10.0
"""What it closes with [N]."""

FRICTIONS = 0.3, 0.5, 0.8
"""Plastic, hard rubber, soft rubber."""

RADII = 0.001, 0.002, 0.004, 0.008, inf
"""Of the pads [m]; the last one stands for a pad that holds every moment."""

NO_TURNING = 1.0
"""Torsional friction of that pad: far more than any of these objects asks for [m]."""


def main() -> None:
    """Print the force for every pad, and the smallest pad for the jaw."""
    print(f"{'rho [N] for pads of [mm]:':25}" + "".join(f"{1000 * radius:9g}" for radius in RADII))
    with tempfile.TemporaryDirectory() as folder:
        tool = Path(folder) / "tool.xml"
        tool.write_text(TOOL)
        size_for("box", read_object(ASSETS / "box" / "box.xml"), Limits(span=OPENING))
        size_for("bottle", read_object(ASSETS / "cylinder" / "cylinder.xml"), Limits(span=OPENING))
        size_for("tool", read_object(tool), Limits(span=OPENING, exclude_geoms=("head",)))


def size_for(name: str, thing: Graspable, limits: Limits) -> None:
    """One object's rows."""
    for friction in FRICTIONS:
        rho = [hold(thing, limits, friction, radius).rho for radius in RADII]
        enough = [radius for radius, force in zip(RADII[:-1], rho, strict=False) if force <= CLOSING]
        pads = f"pads of {1000 * enough[0]:g} mm" if enough else "no such pads"
        row = "".join(f"{force:9.2f}" for force in rho)
        print(f"{name:7} {9.81 * thing.mass:4.2f} N, mu {friction:3.1f} {row}   closing with {CLOSING:g} N: {pads}")


def hold(thing: Graspable, limits: Limits, friction: float, radius: float) -> Grasp:
    """The best two of the same candidates with such pads."""
    candidates = make_candidates(thing, "120", friction, seed=0)  # the same points every time
    soft = candidates.twisting(NO_TURNING, None) if radius == inf else candidates.twisting(None, radius)
    return plan(GraspProblem(thing, make_task("gravity", thing), soft, fingers=2, limits=limits))


if __name__ == "__main__":
    main()
