"""Plan for an object of your own.

An object is an MJCF file with one body that collides. What MuJoCo collides is what is planned on: boxes, cylinders,
capsules, spheres, ellipsoids, and meshes as their convex hulls. So a concave thing, like this hammer, is several geoms
of one body. Its mass and centre of mass come from the geoms' densities.

Three questions are then one call each: where to put the fingers, is the answer true, and what does it look like.

    python scripts/tutorials/own_object.py
"""

import argparse
from pathlib import Path

from planner import GraspProblem, make_candidates, make_task, plan, read_object, verify, write_grasp
from sim.report.report_page import write_report

HAMMER = """
<mujoco model="hammer">
  <worldbody>
    <body name="hammer">
      <freejoint/>
      <geom name="handle" type="capsule" size="0.012" fromto="0 0 0  0 0 0.2" density="700" friction="0.6"/>
      <geom name="head" type="box" size="0.045 0.012 0.012" pos="0 0 0.215" density="4000" friction="0.4"/>
    </body>
  </worldbody>
</mujoco>
"""


def main(folder: Path) -> None:
    """Write the object, plan, check, and leave a grasp file and a page to look at."""
    file = folder / "hammer.xml"
    file.write_text(HAMMER)
    hammer = read_object(file)
    print(f"{hammer.mass:.3f} kg, centre of mass {1000 * hammer.center_of_mass[2]:.0f} mm above the handle's end")

    task = make_task("gravity", hammer)  # its weight in any direction
    candidates = make_candidates(hammer, "80", friction=None, seed=0)  # each geom's own friction
    grasp = plan(GraspProblem(hammer, task, candidates, fingers=3))
    print(f"three fingers need {grasp.rho:.3f} N, on {', '.join(grasp.geoms)}")
    print(f"proven: no three of {grasp.search.candidates} candidates need less than {grasp.lower_bound:.3f} N")

    checks = verify(grasp)
    print(f"{sum(check.holds for check in checks)} of {len(checks)} claims hold")
    write_grasp(folder / "hammer.grasp.json", grasp)
    write_report(folder / "hammer.report.html", hammer, grasp, "hammer.grasp.json")
    print("open hammer.report.html")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=Path, default=Path(), help="where to write; by default here")
    main(parser.parse_args().folder)
