"""What a validation costs: seconds of every stage for one grasp with a given number of fingers and wrenches."""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np

from planner.contacts import Contacts
from planner.objects.object_source import ObjectSource
from planner.objects.parts.sphere import Sphere
from planner.objects.pose import Pose
from planner.objects.rigid_object import RigidObject
from sim.trial.experiment import set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.prediction import predicted_caps
from sim.validation.critical_force import bisect_caps

RADIUS, FRICTION = 0.03, 0.6


@dataclass(frozen=True, kw_only=True)
class Cost:
    """Seconds of one measurement and what came out."""

    fingers: int
    wrenches: int

    set_up: float
    """Composing, compiling and checking the scene [s]."""

    forces: float
    """Feed-forward forces of the verdict [s]."""

    stepping: float
    """Simulation of the verdict: every wrench once [s]."""

    measuring: float
    """Bisection of the cap of every wrench, all included [s]; NaN if not measured."""

    ratio: float
    """Measured over predicted rho; NaN if not measured."""


def measure_cost(fingers: int, wrenches: int, *, bisect: bool) -> Cost:
    """Time the stages on a ball held by evenly spread fingers against random wrenches.

    Args:
        fingers: Number of fingers, 3 or more.
        wrenches: Number of wrenches.
        bisect: Whether to measure every cap too.

    Raises:
        SimulationError: When the experiment cannot be run.
    """
    grasp = _grasp(fingers, wrenches)
    began = perf_counter()
    experiment = set_up(grasp)
    built = perf_counter()
    trial = experiment.active(grasp.wrenches, np.full(wrenches, experiment.protocol.hold_factor))
    answered = perf_counter()
    experiment.perform(trial)
    stepped = perf_counter()
    critical = bisect_caps(experiment) if bisect else None
    return Cost(
        fingers=fingers,
        wrenches=wrenches,
        set_up=built - began,
        forces=answered - built,
        stepping=stepped - answered,
        measuring=perf_counter() - stepped if bisect else np.nan,
        ratio=critical.ratio if critical else np.nan,
    )


def _grasp(fingers: int, wrenches: int) -> LoadedGrasp:
    """A ball, contacts on a Fibonacci spiral around it, and random wrenches of the size of its weight."""
    ball = Sphere(pose=Pose.identity(), radius=RADIUS, geom="ball", friction=FRICTION)
    height = 1 - 2 * (np.arange(fingers) + 0.5) / fingers if fingers > 3 else np.zeros(fingers)
    angle = np.arange(fingers) * (np.pi * (3 - np.sqrt(5)) if fingers > 3 else 2 * np.pi / 3)
    ring = np.sqrt(1 - height**2)
    outward = np.stack([ring * np.cos(angle), ring * np.sin(angle), height], axis=1)
    contacts = Contacts(points=RADIUS * outward, normals=-outward, friction=np.full(fingers, FRICTION))
    held = RigidObject(
        source=ObjectSource(file=Path("ball.xml")),
        sha256="",
        body="ball",
        parts=(ball,),
        mass=1.0,
        center_of_mass=np.zeros(3),
        inertia=np.eye(3),
        extent=np.full(3, 2 * RADIUS),
    )
    loads = np.random.default_rng(0).normal(size=(wrenches, 6)) * np.repeat([1.0, 0.3 * RADIUS], 3)
    return LoadedGrasp(
        rigid_object=held,
        contacts=contacts,
        reference_point=np.zeros(3),
        wrenches=loads,
        phi=predicted_caps(contacts, np.zeros(3), loads),
    )
