"""A scanned power drill (YCB 035): candidates spread over the scan at random, evenly per area. SI."""

from pathlib import Path

import numpy as np
import trimesh

from planner.contacts import Contacts
from planner.errors import ObjectError
from planner.objects.surface.sampling import random_points
from planner.search.problem import SearchProblem
from planner.wrench_sets.box import WrenchBox

OBJECTS = Path(__file__).resolve().parents[2] / ".." / "shared" / "objects"
SCAN = OBJECTS / "ycb_power_drill" / "power_drill" / "textured.obj"
FRICTION = 0.5
FORCE = 1.0
"""[N]"""


def drill_problem(candidates: int, fingers: int, scan: Path = SCAN) -> SearchProblem:
    """A newton along each axis and 0.8 gamma of it as a moment, about the centroid of the surface.

    gamma is the smallest distance of a candidate from the centroid.

    Args:
        candidates: n.
        fingers: m.
        scan: The mesh file.

    Raises:
        ObjectError: When the scan is not there.
    """
    if not scan.is_file():
        raise ObjectError(f"the scan {scan.name} of the power drill is not beside the repository; leave it out")
    mesh = trimesh.load_mesh(scan, process=False, skip_materials=True)
    points, face = random_points(mesh.triangles, candidates, np.random.default_rng(0))
    a, b, c = mesh.triangles[face].transpose(1, 0, 2)
    inward = np.cross(c - a, b - a)
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    contacts = Contacts(points=points, normals=inward, friction=np.full(candidates, FRICTION))
    centroid = np.array(mesh.centroid)
    moment = 0.8 * FORCE * float(np.linalg.norm(points - centroid, axis=1).min())
    task = WrenchBox(force=(FORCE,) * 3, moment=(moment,) * 3)
    return SearchProblem(contacts=contacts, fingers=fingers, reference_point=centroid, wrenches=task.vertices())
