"""DexGraspBench's force-closure test with fingertips: six pushes, one at a time, from every side.

Gravity is off. The hand closes, squeezes, and the object is pushed with 10 N per kilogram along one axis for two
seconds; six simulations, one per direction. A grasp passes if the object never moves 5 cm or turns 15 degrees.
No torque is applied, and the 10 m/s^2 say nothing of the force the fingers may use: whoever runs it names the squeeze.

Source: Chen et al., "BODex", ICRA 2025, and its benchmark's `fc_mocap` evaluation. Emulated: the hand (fingertips
with springs; its durations of closing and squeezing become one), the push directions (body axes of the object).
"""

import numpy as np

from planner.contacts import Contacts
from planner.objects.rigid_object import RigidObject
from sim.benches.bench import BenchOutcome, run_bench
from sim.benches.settings import BenchSettings

DEXGRASPBENCH = BenchSettings(
    name="DexGraspBench fc (fingertips)",
    object_mass=0.1,
    friction=0.6,
    torsional_friction=0.02,
    solref=(0.0125, 1.0),  # MuJoCo mixes half and half: the hand's 0.005 and its default 0.02 of the object
    solimp=(0.7, 0.97, 5.5e-4, 0.5, 2.0),  # likewise 0.5 0.99 1e-4 and 0.9 0.95 1e-3
    impratio=10.0,
    timestep=4e-3,
    iterations=100,  # MuJoCo's default, as is the tolerance
    tolerance=1e-8,
    noslip_iterations=2,
    ccd_tolerance=1e-6,
    squeeze_time=0.5,
    tugs=(((-1, 0, 0),), ((1, 0, 0),), ((0, -1, 0),), ((0, 1, 0),), ((0, 0, -1),), ((0, 0, 1),)),
    tug_time=2.0,
    tug_acceleration=10.0,
    check_interval=0.2,
    translation_limit=0.05,
    rotation_limit=float(np.deg2rad(15.0)),
)


def dexgraspbench(rigid_object: RigidObject, contacts: Contacts, squeeze: float) -> BenchOutcome:
    """Run the six pushes.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp in the body frame; its friction is replaced by the benchmark's.
        squeeze: Largest force with which a fingertip squeezes before the push [N].

    Raises:
        SettingError: When the squeeze is not a positive, finite force.
        SimulationError: When a fingertip is not where it was planned or MuJoCo cannot build or run the test.
    """
    return run_bench(rigid_object, contacts, squeeze, DEXGRASPBENCH)
