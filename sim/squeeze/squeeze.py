"""The passive squeeze measured: how far the preload can shrink before some finger slides.

The fingers push with the constant preload that the prediction chose (planner/forces/squeeze.py) and yield like
springs; nothing adapts and nothing is capped. Scaling that preload by c scales the allowed force c s with it, s the
predicted squeeze_force. A scale holds a wrench when no finger slides, none loses the object, none feels more than
its share c s and the object stays where it was but for the springs. The theory says: every wrench above c = 1, not
all of them below. Bisecting c measures the need.

Slip here is the onset at one finger. The others would often catch the object, each at a force nobody planned.
"""

from dataclasses import dataclass, replace

import numpy as np

from planner.arrays import Floats, Indices
from planner.errors import SimulationError
from planner.files.package_versions import package_versions
from planner.forces.squeeze import SqueezeNeed, squeeze_need
from planner.progress import Done, Observe
from sim.trial.experiment import Experiment, set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.measurement import measure
from sim.trial.protocol import ACTIVE, ValidationProtocol
from sim.trial.schedule import steps
from sim.trial.trial import Trial, run
from sim.trial.workload import each_step

SQUEEZE = replace(
    ACTIVE,
    name="rhograsp.squeeze/1",
    stiffness=3e4,  # the theory's twists are small: at 100 N/m Case III moves by 3 % of R0, here by 1e-4
    tip_mass=1.0,  # so that this spring swings in 36 ms, well resolved by the time step, well below the ramp
    object_mass=0.3,
    object_damping=0.0,
    slip_tolerance=1e-5,  # a stiff finger that slides gives way by little: seen 2e-5 below the need, 1e-6 above
    motion_tolerance=1e-2,  # springs give way; beyond this the twists are not small
    hold_time=0.15,  # nothing adapts, so nothing more happens
)
"""Forces do not adapt: a constant preload and stiff springs, stiff so that the grasp keeps its shape."""

FORCE_TOLERANCE = 2e-3
"""A finger feels no more than its share when it exceeds it by less than this part."""
SPAN = 0.1
"""The bisection starts from a band of this half width about the prediction."""
SQUEEZING = "simulations (smaller and larger squeezes)"
HALVINGS = 6
"""They narrow the band to 0.3 % of the prediction."""
AGREEMENT = 0.01
"""Prediction and measurement agree when they differ by less than this part: seen 0.0063 at most on 23 grasps."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SqueezeForce:
    """Bracket of the measured need of a passive squeeze beside its prediction. Not rho."""

    predicted: SqueezeNeed

    lower: float
    """Largest allowed force with which some wrench slipped [N]; zero if even the lowest tried held all."""

    upper: float
    """Least allowed force with which every wrench held [N]; infinite if even the highest tried did not, or if no
    preload can be predicted to hold."""

    critical_wrench: int | None
    """The wrench that slipped most at `lower`; none if none slipped."""

    protocol: ValidationProtocol

    versions: dict[str, str]
    """Of the packages that can change the outcome."""

    @property
    def confirmed(self) -> bool:
        """Whether the whole bracket lies within AGREEMENT of the prediction; never without a preload that holds."""
        force = self.predicted.squeeze_force
        return self.lower >= (1 - AGREEMENT) * force and self.upper <= (1 + AGREEMENT) * force < np.inf


def measure_squeeze_force(
    grasp: LoadedGrasp,
    protocol: ValidationProtocol = SQUEEZE,
    simulated_friction: Floats | None = None,
    observe: Observe = lambda *_: None,
) -> SqueezeForce:
    """Predict and measure what the grasp needs when its forces do not adapt.

    Args:
        grasp: What is measured; its rho plays no role.
        protocol: Settings and thresholds.
        simulated_friction: Friction in the simulator, shape (contacts,); the planned one if None.
        observe: Told now and then how many simulations are done, and of how many at most.

    Raises:
        ContactError: When a finger's strength is not 1, or it has torsional friction.
        SimulationError: When a fingertip is not where it was planned or the experiment cannot be built or run.
        SolverError: When the prediction fails.
    """
    need = squeeze_need(grasp.contacts, grasp.reference_point, grasp.wrenches)
    lower, upper, critical = 0.0, np.inf, None
    if need.feasible:
        experiment = set_up(grasp, protocol, simulated_friction, newton=need.squeeze_force)
        if experiment.static.reasons():
            raise SimulationError("; ".join(experiment.static.reasons()))
        lower, upper, critical = _bisected(experiment, need, observe)
    return SqueezeForce(
        predicted=need,
        lower=lower * need.squeeze_force if lower > 0 else 0.0,
        upper=upper * need.squeeze_force,
        critical_wrench=critical,
        protocol=protocol,
        versions=package_versions(),
    )


def _bisected(experiment: Experiment, need: SqueezeNeed, observe: Observe) -> tuple[float, float, int | None]:
    """Bracket of the scale and the wrench that slips most below it.

    A wrench that holds at one scale holds at every larger one, so each halving runs only those that slipped.
    """
    lower, upper, critical = 1 - SPAN, 1 + SPAN, None
    suspects: Indices = np.arange(len(experiment.grasp.wrenches))
    finished, rounds = 0, 2 + HALVINGS

    def test(scale: float) -> tuple[Indices, int | None]:
        nonlocal finished, rounds
        before, expected = finished, finished + rounds * len(suspects)
        finished, rounds = finished + len(suspects), rounds - 1
        return _slipped(experiment, need, suspects, scale, lambda done: observe(SQUEEZING, before + done, expected))

    slipped, most = test(lower)
    if not slipped.size:
        return 0.0, lower, None
    suspects, critical = slipped, most
    slipped, most = test(upper)
    if slipped.size:
        return upper, np.inf, most
    for _ in range(HALVINGS):
        middle = (lower + upper) / 2
        slipped, most = test(middle)
        if slipped.size:
            lower, suspects, critical = middle, slipped, most
        else:
            upper = middle
    return lower, upper, critical


def _slipped(
    experiment: Experiment,
    need: SqueezeNeed,
    rows: Indices,
    scale: float,
    observe: Done,
) -> tuple[Indices, int | None]:
    """Which of the wrenches at `rows` are not held with the preload scaled, and the one that slips most."""
    units, protocol = experiment.units, experiment.protocol
    preload = np.repeat(scale * units.force * need.preload[None], len(rows), axis=0)
    uncapped = np.full(len(rows), np.inf)
    loads = units.wrenches(experiment.grasp.wrenches[rows])
    trial = Trial(
        wrenches=loads,
        caps=uncapped,
        preloads=preload,
        preload_wrenches=np.zeros_like(loads),
        forces=preload,
        torques=np.zeros(preload.shape[:2]),
    )
    final = run(experiment.scene, trial, protocol, each_step(observe, len(rows), steps(protocol)))
    outcome = measure(experiment.scene, trial, final, 1.0, protocol)
    shares = np.linalg.norm(preload + units.force * (need.forces[rows] - need.preload), axis=2)
    judged = shares > protocol.loaded * scale  # a finger the wrench relieves may slide
    slips = np.where(judged, outcome.slips, 0.0).max(axis=1)
    lost = (judged & (outcome.measured_forces == 0)).any(axis=1)
    overloaded = (outcome.measured_forces > (1 + FORCE_TOLERANCE) * scale).any(axis=1)
    moved = np.maximum(outcome.translations, outcome.rotations) >= protocol.motion_tolerance
    failed = (slips >= protocol.slip_tolerance) | lost | overloaded | moved
    return rows[failed], int(rows[slips.argmax()]) if failed.any() else None
