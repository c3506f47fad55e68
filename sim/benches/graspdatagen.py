"""GraspDataGen's tug test with fingertips: five tugs of one g in a row, and who still touches at the end.

Gravity is off, the object weighs one kilogram, friction is 1. The gripper closes for a second, then the object is
tugged with its own weight for half a second along each of [0,0,1], [0,2,1], [0,-2,1], [2,0,1] and [-2,0,1],
normalised. A grasp passes if every finger touches the object at the end, wherever the object is by then.

Source: NVIDIA GraspDataGen, `grasp_sim.py`. Emulated: the gripper (fingertips with springs), its frame (z is the
approach there, but fingertips have none: the tugs are along the axes of the object's body), and PhysX: its contact
settings have no counterpart, so this project's own are used.
"""

import numpy as np

from planner.contacts import Contacts
from planner.objects.rigid_object import RigidObject
from sim.benches.bench import BenchOutcome, run_bench
from sim.benches.settings import BenchSettings

AWAY, ASIDE = float(np.sqrt(0.2)), float(np.sqrt(0.8))
"""Components of [0, 2, 1] normalised."""

GRASPDATAGEN = BenchSettings(
    name="GraspDataGen tugs (fingertips)",
    object_mass=1.0,
    friction=1.0,
    squeeze_time=1.0,
    tugs=(((0, 0, 1), (0, ASIDE, AWAY), (0, -ASIDE, AWAY), (ASIDE, 0, AWAY), (-ASIDE, 0, AWAY)),),
    tug_time=0.5,
    tug_acceleration=9.81,
    check_interval=0.1,
    contact_at_end=True,
)


def graspdatagen(rigid_object: RigidObject, contacts: Contacts, squeeze: float) -> BenchOutcome:
    """Run the five tugs.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp in the body frame; its friction is replaced by the benchmark's.
        squeeze: Largest force with which a fingertip squeezes before the tugs [N].

    Raises:
        SettingError: When the squeeze is not a positive, finite force.
        SimulationError: When a fingertip is not where it was planned or MuJoCo cannot build or run the test.
    """
    return run_bench(rigid_object, contacts, squeeze, GRASPDATAGEN)
