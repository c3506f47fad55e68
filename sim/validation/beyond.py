"""Beyond the vertices: rho must hold for everything in W_R, at rest and in motion, and for nothing outside.

That a grasp which holds the vertices holds their convex hull is a theorem about balanced forces in convex cones;
here it is an experiment. Wrenches in and on W_R, and loads that wander inside it, must be held with the cap above
rho; the critical wrench a little enlarged must slip with the cap at rho.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from planner.progress import Done
from sim.trial.experiment import Experiment
from sim.trial.measurement import Measurement, measure
from sim.trial.protocol import ValidationProtocol
from sim.trial.schedule import fractions
from sim.trial.trial import Trial, step_through
from sim.validation.wrench_samples import boundary_wrenches, interior_wrenches, rotating_forces, rotating_wrenches

SAMPLES = 32
"""Random interior wrenches, and as many on the boundary."""
RANDOM_PATHS = 3
"""Closed paths in random planes, beside three of rotating gravity."""
TURN_TIME = 0.6
"""Seconds of one turn [s]: slow enough to be quasi-static."""
OUTSIDE = 1.02
"""The critical wrench times this is outside of what rho can hold."""
SIMULATIONS = 2 * SAMPLES + 1 + 3 + RANDOM_PATHS
"""At most so many are run."""


@dataclass(frozen=True, kw_only=True)
class Loads:
    """Loads of one kind other than the vertices, and whether they were held."""

    kind: str
    """In words."""

    loads: int
    """How many were tried."""

    held: int
    """How many of them were held."""

    must_hold: bool
    """Else all must slip."""

    slips: tuple[float, ...]
    """Largest slip of a loaded finger over R0, per load."""

    @classmethod
    def of(cls, kind: str, outcome: Measurement, *, must_hold: bool) -> "Loads":
        """What was measured of them, one simulation per load."""
        held, slips = outcome.held, tuple(outcome.slip.tolist())
        return cls(kind=kind, loads=len(held), held=int(held.sum()), must_hold=must_hold, slips=slips)

    def objection(self) -> str | None:
        """Why rho is refuted; None unless some slipped that must hold."""
        if not self.must_hold or self.held == self.loads:
            return None
        slipped = self.loads - self.held
        return f"{slipped} of {self.loads} {self.kind} were not held (largest slip {max(self.slips):.2g} R0)"

    def doubt(self) -> str | None:
        """Why the experiment is not to be trusted; None unless some were held that must slip."""
        if self.must_hold or not self.held:
            return None
        return f"{self.kind} was held: the experiment cannot fail"


def measure_beyond(experiment: Experiment, seed: int = 0, observe: Done = lambda _: None) -> tuple[Loads, ...]:
    """Measure wrenches inside, on and outside W_R, and loads that turn inside, where W_R has room for any.

    Args:
        experiment: Set up for the rho of its grasp.
        seed: Of the random wrenches.
        observe: Called now and then with how many of the SIMULATIONS are done.

    Raises:
        SimulationError: When MuJoCo stops or loses a simulation.
    """
    rng = np.random.default_rng(seed)
    factor, wrenches = experiment.protocol.hold_factor, experiment.grasp.wrenches
    inside = interior_wrenches(wrenches, SAMPLES, rng)
    boundary = boundary_wrenches(wrenches, SAMPLES, rng)
    outside = OUTSIDE * wrenches[experiment.grasp.critical_wrench][None]
    caps = np.append(np.full(2 * SAMPLES, factor), 1.0)
    outcome = experiment.measure(np.vstack([inside, boundary, outside]), caps, observe)
    paths = np.concatenate([rotating_forces(wrenches), rotating_wrenches(wrenches, RANDOM_PATHS, rng)])
    beyond = [
        Loads.of("wrenches inside W_R", outcome.rows(slice(0, SAMPLES)), must_hold=True),
        Loads.of("wrenches on the boundary of W_R", outcome.rows(slice(SAMPLES, 2 * SAMPLES)), must_hold=True),
    ]
    if len(paths):
        turned = measure_paths(experiment, paths, factor)
        beyond.append(Loads.of("loads turning inside W_R", turned, must_hold=True))
    enlarged = f"{OUTSIDE:g} critical wrench with the cap at rho"
    return (*beyond, Loads.of(enlarged, outcome.rows(slice(-1, None)), must_hold=False))


def measure_paths(experiment: Experiment, paths: Floats, cap: float) -> Measurement:
    """Let each load follow its path, the forces answering it, and judge the end.

    Between two corners wrench and forces change linearly: what balances at both, within cones and cap, does so
    between them.

    Args:
        experiment: Set up.
        paths: Shape (paths, corners, 6) [N, N m].
        cap: Relative to rho.

    Raises:
        SimulationError: When MuJoCo stops or loses a simulation.
    """
    count, corners = paths.shape[:2]
    answers = experiment.active(paths.reshape(-1, 6), np.full(count * corners, cap))
    wrenches = answers.wrenches.reshape(count, corners, 6)
    forces = answers.forces.reshape(count, corners, -1, 3)
    torques = answers.torques.reshape(count, corners, -1)
    caps = answers.caps[::corners]
    first, last = (
        Trial(
            wrenches=wrenches[:, corner],
            caps=caps,
            preloads=answers.preloads[::corners],
            preload_wrenches=answers.preload_wrenches[::corners],
            forces=forces[:, corner],
            torques=torques[:, corner],
        )
        for corner in (0, -1)
    )
    loads = _along(first, wrenches, forces, experiment.protocol)
    protocol = experiment.protocol
    final = step_through(experiment.scene, loads, caps, protocol, lost=protocol.lost)
    return measure(experiment.scene, last, final, 1 / experiment.units.force, experiment.protocol)


def _along(
    first: Trial, wrenches: Floats, forces: Floats, protocol: ValidationProtocol
) -> Iterator[tuple[Floats, Floats]]:
    """Wrenches and forces of every step: up to the first corner as in any trial, then from corner to corner."""
    rise = round((protocol.preload_time + protocol.ramp_time) / protocol.timestep)
    for squeeze, load in fractions(protocol)[:rise]:
        yield first.at(squeeze, load)
    steps = round(TURN_TIME / protocol.timestep)
    for place in np.linspace(0.0, wrenches.shape[1] - 1.0, steps, endpoint=False) + (wrenches.shape[1] - 1.0) / steps:
        corner = min(int(place), wrenches.shape[1] - 2)
        share = place - corner
        yield (
            (1 - share) * wrenches[:, corner] + share * wrenches[:, corner + 1],
            (1 - share) * forces[:, corner] + share * forces[:, corner + 1],
        )
