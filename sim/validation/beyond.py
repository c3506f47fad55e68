"""Beyond the vertices: rho must hold for everything in W_R, at rest and in motion, and for nothing outside.

That a grasp which holds the vertices holds their convex hull is a theorem about balanced forces in convex cones;
here it is an experiment. Wrenches in and on W_R, and loads that wander inside it, must be held with the cap above
rho; the critical wrench a little enlarged must slip with the cap at rho.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

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


@dataclass(frozen=True, eq=False, kw_only=True)
class Beyond:
    """Outcomes beyond the vertices."""

    interior: Measurement
    """Random wrenches inside W_R; must be held."""

    boundary: Measurement
    """Random wrenches on the boundary of W_R; must be held."""

    paths: Measurement | None
    """Loads that turn inside W_R, at the end of one turn; must be held. None where W_R has room for none."""

    outside: Measurement
    """The critical wrench enlarged, with the cap at rho; must slip."""

    def kinds(self) -> tuple[tuple[str, Measurement, bool], ...]:
        """Every kind of load that was tried, in words, its outcomes, and whether they must hold."""
        paths = (("loads turning inside W_R", self.paths, True),) if self.paths is not None else ()
        return (
            ("wrenches inside W_R", self.interior, True),
            ("wrenches on the boundary of W_R", self.boundary, True),
            *paths,
            (f"{OUTSIDE:g} critical wrench with the cap at rho", self.outside, False),
        )

    def objections(self) -> tuple[str, ...]:
        """One sentence per kind of load that was not held."""
        return tuple(
            f"{(~outcome.held).sum()} of {len(outcome.held)} {kind} were not held (largest slip "
            f"{outcome.slip.max():.2g} R0)"
            for kind, outcome, must_hold in self.kinds()
            if must_hold and not outcome.held.all()
        )

    def doubts(self) -> tuple[str, ...]:
        """Why the experiment is not to be trusted, if what is outside was held."""
        if not self.outside.held.any():
            return ()
        return (f"{OUTSIDE:g} times the critical wrench was held with the cap at rho: the experiment cannot fail",)


def measure_beyond(experiment: Experiment, seed: int = 0, observe: Done = lambda _: None) -> Beyond:
    """Measure wrenches inside, on and outside W_R, and loads that turn inside.

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
    return Beyond(
        interior=outcome.rows(slice(0, SAMPLES)),
        boundary=outcome.rows(slice(SAMPLES, 2 * SAMPLES)),
        paths=measure_paths(experiment, paths, factor) if len(paths) else None,
        outside=outcome.rows(slice(-1, None)),
    )


def measure_paths(experiment: Experiment, paths: np.ndarray, cap: float) -> Measurement:
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
    first: Trial, wrenches: np.ndarray, forces: np.ndarray, protocol: ValidationProtocol
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
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
