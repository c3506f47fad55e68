"""The four controls of a validation: less cap, no load, less friction, another contact."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from planner.contact_models.friction_cone import utilisation
from planner.contacts import Contacts
from planner.millimetres import in_mm
from planner.objects.rigid_object import RigidObject
from sim.trial.experiment import Experiment, set_up
from sim.trial.feed_forward import FeedForward
from sim.trial.measurement import Measurement
from sim.trial.prediction import on_friction_limit, predicted_caps
from sim.trial.protocol import ValidationProtocol
from sim.trial.trial import Trial
from sim.validation.control_experiment import Control
from sim.validation.displacement import DisplacedGrasp, displaced_grasps


def cap_control(outcome: Measurement, critical_wrench: int, phi: float, protocol: ValidationProtocol) -> Control:
    """The critical wrench with the cap below rho must slip.

    Args:
        outcome: That simulation alone.
        critical_wrench: Its index among the vertices.
        phi: Its predicted cap [N].
        protocol: Settings.
    """
    return Control(
        name="cap",
        change=f"critical wrench {critical_wrench} with the cap at {protocol.control_factor:g} rho",
        wrenches=np.array([critical_wrench]),
        phi=np.array([phi]),
        caps=outcome.caps,
        slips=outcome.slip,
        held=outcome.held,
        expected=np.array([False]),
        counted=np.array([True]),
    )


def squeezes(experiment: Experiment) -> bool:
    """Whether the internal force that fingers without load take fits the planned cones."""
    contacts, margin = experiment.contacts, experiment.protocol.friction_margin
    forces = FeedForward(contacts, experiment.units.reference_point).internal_force(1.0)
    return bool(forces.any() and (utilisation(forces, contacts.normals) <= margin * contacts.friction).all())


def creep_control(
    outcome: Measurement,
    protocol: ValidationProtocol,
    part: float,
    critical_wrench: int,
    phi: float,
    *,
    decidable: bool,
) -> Control:
    """Fingers that only squeeze must not creep; where they cannot squeeze, nor under a light load.

    Args:
        outcome: That simulation alone.
        protocol: Settings.
        part: Of the critical wrench that acts; zero for no load.
        critical_wrench: Its index among the vertices.
        phi: Predicted cap of what acts [N].
        decidable: Whether what acts keeps off the friction limit.
    """
    load = f"these fingers cannot squeeze; {part:g} of critical wrench {critical_wrench}" if part else "no load"
    return Control(
        name="creep",
        change=f"{load}; the slip must stay below {protocol.creep_tolerance:g} R0",
        wrenches=np.array([critical_wrench if part else -1]),
        phi=np.array([phi]),
        caps=outcome.caps,
        slips=outcome.slip,
        held=outcome.held & (outcome.slip < protocol.creep_tolerance),
        expected=np.array([True]),
        counted=np.array([decidable]),
    )


def friction_control(
    experiment: Experiment,
    trial: Trial,
    reference_point: np.ndarray,
    wrenches: np.ndarray,
    observe: Callable[[float], None] = lambda _: None,
) -> Control:
    """With less friction in the simulator exactly the wrenches must slip whose predicted cap is then above the cap.

    The friction is lowered until theory says that some wrench is lost: a grasp that friction does not limit holds as
    before with a little less of it. The fingers do the same as before: their forces do not know the friction.

    Args:
        experiment: With the planned contacts.
        trial: Every wrench at the cap of the verdict.
        reference_point: p_o, shape (3,) [m].
        wrenches: The same wrenches, shape (wrenches, 6) [N, N m].
        observe: Called now and then with how many simulations are done.

    Raises:
        SimulationError: When MuJoCo stops or loses a simulation.
    """
    protocol, contacts = experiment.protocol, experiment.contacts
    cap = float(trial.caps.max()) / experiment.units.force
    factor, phi = _losing_friction(contacts, reference_point, wrenches, cap, protocol)
    friction = factor * contacts.friction
    outcome = experiment.with_friction(friction).perform(trial, observe)
    return Control(
        name="friction",
        change=f"friction at {factor:.3g} of the planned, cap at {protocol.hold_factor:g} rho",
        wrenches=np.arange(len(wrenches)),
        phi=phi,
        caps=outcome.caps,
        slips=outcome.slip,
        held=outcome.held,
        expected=phi < outcome.caps,
        counted=np.abs(phi / outcome.caps - 1) > protocol.ambiguity,
    )


def _losing_friction(
    contacts: Contacts, reference_point: np.ndarray, wrenches: np.ndarray, cap: float, protocol: ValidationProtocol
) -> tuple[float, np.ndarray]:
    """The part of the friction at which theory says that some wrench is lost, and every wrench's phi there.

    Where none is so low, the first part that was tried: every wrench must then be held.
    """
    tried = []
    factor = protocol.friction_factor
    while factor >= protocol.least_friction:
        slippery = replace(contacts, friction=factor * contacts.friction)
        tried.append((factor, predicted_caps(slippery, reference_point, wrenches)))
        if (tried[-1][1] > (1 + protocol.ambiguity) * cap).any():
            return tried[-1]
        factor *= protocol.friction_factor
    return tried[0]


def displacement_control(
    rigid_object: RigidObject,
    contacts: Contacts,
    reference_point: np.ndarray,
    wrenches: np.ndarray,
    critical_wrench: int,
    protocol: ValidationProtocol,
) -> Control:
    """A grasp with one contact moved must have the rho predicted for it, held just above and lost just below.

    Of all small displacements the one is taken that changes the predicted cap of the critical wrench most.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp, with the planned friction.
        reference_point: p_o, shape (3,) [m].
        wrenches: Vertices of W_R about p_o, shape (wrenches, 6) [N, N m].
        critical_wrench: Index of the wrench that decides rho.
        protocol: Settings.

    Raises:
        SimulationError: When the experiment cannot be built or run.
    """
    for grasp in _by_change(rigid_object, contacts, reference_point, wrenches[critical_wrench], protocol):
        phi = predicted_caps(grasp.contacts, reference_point, wrenches)
        rho, friction = float(phi.max()), contacts.friction
        if not np.isfinite(rho):
            continue
        experiment = set_up(rigid_object, grasp.contacts, reference_point, rho, friction, protocol)
        if experiment.static.reasons():
            continue
        worst = int(phi.argmax())
        if on_friction_limit(grasp.contacts, reference_point, wrenches[[worst]], protocol.friction_margin)[0]:
            continue
        outcome = experiment.measure(
            wrenches[[worst, worst]], np.array([protocol.hold_factor, protocol.control_factor])
        )
        return Control(
            name="displaced contact",
            change=f"finger {grasp.finger + 1} moved {in_mm(grasp.distance, 3)} mm, its own rho {phi.max():.5g} N",
            wrenches=np.array([worst, worst]),
            phi=phi[[worst, worst]],
            caps=outcome.caps,
            slips=outcome.slip,
            held=outcome.held,
            expected=np.array([True, False]),
            counted=np.array([True, True]),
        )
    return _impossible("displaced contact", "no contact can move along its face and leave a grasp off its limits")


def _impossible(name: str, why: str) -> Control:
    """A control that this grasp does not allow."""
    numbers, answers = np.zeros(0), np.zeros(0, dtype=bool)
    return Control(
        name=name,
        change=why,
        wrenches=np.zeros(0, dtype=int),
        phi=numbers,
        caps=numbers,
        slips=numbers,
        held=answers,
        expected=answers,
        counted=answers,
    )


def _by_change(
    rigid_object: RigidObject,
    contacts: Contacts,
    reference_point: np.ndarray,
    wrench: np.ndarray,
    protocol: ValidationProtocol,
) -> list[DisplacedGrasp]:
    """Displaced grasps that can balance the wrench, the one whose cap for it changed most first."""
    distance = protocol.displacement * rigid_object.size
    grasps = [DisplacedGrasp(contacts=contacts, finger=0, distance=0.0)]
    grasps += displaced_grasps(rigid_object, contacts, distance)
    caps = [predicted_caps(grasp.contacts, reference_point, wrench[None])[0] for grasp in grasps]
    changes = np.abs(np.array(caps[1:]) - caps[0])
    return [grasps[1 + index] for index in np.argsort(-changes, kind="stable") if np.isfinite(changes[index])]
