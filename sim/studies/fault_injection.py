"""Planners that are wrong, on purpose: would the measurement notice?

An injected fault lets the planner believe something false, and if it misleads also the fingers, while the simulation
stays true. The wrong prediction is then compared with what MuJoCo measures.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts, contact_frames
from planner.forces.cvxpy_forces import CvxpyForces
from planner.forces.problem import ForceProblem
from sim.trial.experiment import Experiment, set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.prediction import predicted_caps
from sim.trial.protocol import ValidationProtocol
from sim.trial.trial import Trial
from sim.validation.critical_force import CriticalForce, bisect_caps

Belief = Callable[[Floats, float], Floats]
"""From the true wrenches, shape (l, 6) [N, N m], and R0 [m] to the believed ones."""
Prediction = Callable[[Contacts, Floats, Floats], Floats]
"""Contacts, reference point and wrenches to phi, as `predicted_caps`."""

OFFSET = 0.05 * np.array([1.0, 1.0, 1.0]) / np.sqrt(3)
"""Error of the moment's reference point over R0."""


@dataclass(frozen=True, kw_only=True)
class InjectedFault:
    """One way to be wrong."""

    name: str

    believed: Belief = lambda wrenches, _: wrenches
    """The wrenches that the planner believes in."""

    misleads: bool = False
    """Whether the fingers believe in them too."""

    predict: Prediction = predicted_caps
    """How the planner predicts."""

    friction_factor: float = 1.0
    """Friction in the simulator over the planned."""

    torsion_factor: float = 1.0
    """Torsional friction in the simulator over the planned."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MisledExperiment(Experiment):
    """An experiment whose fingers answer wrenches other than those that come."""

    believed: Callable[[Floats], Floats]
    """From the true wrenches to the believed ones, shape (l, 6) [N, N m]."""

    def active(self, wrenches: Floats, caps: Floats) -> Trial:
        """Forces for what is believed, wrenches as they are."""
        trial = super().active(self.believed(wrenches), caps)
        return replace(trial, wrenches=self.units.wrenches(wrenches))


class PyramidForces(CvxpyForces):
    """Subproblem 2 with the friction cone's circle replaced by an inscribed regular polygon."""

    sides: int

    def tangent_map(self, normal: Floats) -> Floats:
        """Distances from the polygon's sides: outward normals of the sides in the tangent plane, shape (sides, 3)."""
        angles = 2 * np.pi * np.arange(self.sides) / self.sides
        tangents = contact_frames(normal[None])[0, :, 1:]
        return np.stack([np.cos(angles), np.sin(angles)], axis=1) @ tangents.T

    def inequalities(self, cap: Any, force: Any, limit: Any, tangential: Any) -> list[Any]:
        """See `CvxpyForces.inequalities`."""
        import cvxpy as cp

        return [tangential <= np.cos(np.pi / self.sides) * limit, cp.norm(force) <= cap]


class SquareForces(PyramidForces):
    """The pyramid most simulators default to."""

    sides = 4


class OctagonForces(PyramidForces):
    """Eight sides."""

    sides = 8


class ApartForces(CvxpyForces):
    """Subproblem 2 with torsion in a cone of its own: sliding and twisting both at their most, at once."""

    def tangent_map(self, normal: Floats) -> Floats:
        """The tangential force in body axes, shape (3, 3)."""
        return np.eye(3) - np.outer(normal, normal)

    def inequalities(self, cap: Any, force: Any, limit: Any, tangential: Any) -> list[Any]:
        """See `CvxpyForces.inequalities`."""
        import cvxpy as cp

        return [cp.norm(tangential[:-1]) <= limit, cp.abs(tangential[-1]) <= limit, cp.norm(force) <= cap]


def _by(forces: type[PyramidForces]) -> Prediction:
    def predict(contacts: Contacts, reference_point: Floats, wrenches: Floats) -> Floats:
        return _solved(forces(len(contacts), contacts.dimension), contacts, reference_point, wrenches)

    return predict


def _torsion_apart(contacts: Contacts, reference_point: Floats, wrenches: Floats) -> Floats:
    solver = ApartForces(len(contacts), contacts.dimension, twisting=True)
    return _solved(solver, contacts, reference_point, wrenches)


def _torsion_dropped(contacts: Contacts, reference_point: Floats, wrenches: Floats) -> Floats:
    return predicted_caps(replace(contacts, torsion=None), reference_point, wrenches)


def _solved(solver: CvxpyForces, contacts: Contacts, reference_point: Floats, wrenches: Floats) -> Floats:
    problems = [ForceProblem(contacts=contacts, reference_point=reference_point, wrench=wrench) for wrench in wrenches]
    return np.array([solver.solve(problem).phi for problem in problems])


def _about_a_wrong_point(wrenches: Floats, radius: float) -> Floats:
    return np.hstack([wrenches[:, :3], wrenches[:, 3:] - np.cross(radius * OFFSET, wrenches[:, :3])])


def _with_moments_reversed(wrenches: Floats, _: float) -> Floats:
    return wrenches * np.repeat([1.0, -1.0], 3)


INJECTED_FAULTS = (
    InjectedFault(name="none"),
    InjectedFault(name="4-sided inscribed pyramid", predict=_by(SquareForces)),
    InjectedFault(name="8-sided inscribed pyramid", predict=_by(OctagonForces)),
    InjectedFault(name="moment reference off by 0.05 R0", believed=_about_a_wrong_point),
    InjectedFault(name="wrench 3 % larger in truth", believed=lambda wrenches, _: wrenches / 1.03),
    InjectedFault(name="friction 5 % lower in truth", friction_factor=0.95),
    InjectedFault(name="moment sign wrong", believed=_with_moments_reversed, misleads=True),
)
"""The table of ways to be wrong, the honest planner first."""

SOFT_FAULTS = (
    InjectedFault(name="none"),
    InjectedFault(name="torsion dropped", predict=_torsion_dropped),
    InjectedFault(name="torsion beside the friction cone, not in it", predict=_torsion_apart),
    InjectedFault(name="torsion 5 % lower in truth", torsion_factor=0.95),
    InjectedFault(name="friction 5 % lower in truth, torsion with it", friction_factor=0.95),
)
"""Ways to be wrong about fingers that twist."""


def measure_fault(
    grasp: LoadedGrasp, fault: InjectedFault, protocol: ValidationProtocol | None = None
) -> CriticalForce | None:
    """What MuJoCo measures against the wrong prediction.

    Args:
        grasp: A feasible grasp.
        fault: What is wrong.
        protocol: Settings; by default those for such contacts, `active_protocol`.

    Returns:
        Measured caps beside the wrong prediction; None where the wrong planner finds no grasp at all.

    Raises:
        SimulationError: When the experiment cannot be run.
    """
    contacts, point, wrenches = grasp.contacts, grasp.reference_point, grasp.wrenches
    radius = float(np.linalg.norm(contacts.points - point, axis=1).max())
    phi = fault.predict(contacts, point, fault.believed(wrenches, radius))
    if not np.isfinite(phi).all():
        return None
    factor = fault.friction_factor
    experiment = set_up(replace(grasp, phi=phi), protocol, newton=grasp.rho)
    true = contacts.with_friction(factor * contacts.friction)
    experiment = experiment.with_friction(replace(true, torsion=fault.torsion_factor * true.torsions))
    if fault.misleads:
        experiment = MisledExperiment(**vars(experiment), believed=lambda true: fault.believed(true, radius))
    return bisect_caps(experiment)
