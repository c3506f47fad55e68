"""The controls of a validation: less cap, no load, less friction, another contact, and less torsional friction."""

from dataclasses import replace

import numpy as np

from planner.arrays import Floats
from planner.contact_models.models import model_of
from planner.files.json_document import Column, as_rows
from planner.millimetres import in_mm
from planner.progress import Done
from sim.trial.experiment import Experiment, set_up
from sim.trial.feed_forward import FeedForward
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.measurement import Measurement
from sim.trial.prediction import predicted_caps
from sim.trial.protocol import ValidationProtocol
from sim.trial.trial import Trial
from sim.validation.control_experiment import ControlExperiment, ControlOutcome
from sim.validation.displacement import DisplacedGrasp, displaced_grasps


def cap_control(outcome: Measurement, grasp: LoadedGrasp, protocol: ValidationProtocol) -> ControlExperiment:
    """The critical wrench with the cap below rho must slip.

    Args:
        outcome: That simulation alone.
        grasp: What is measured.
        protocol: Settings.
    """
    critical_wrench = grasp.critical_wrench
    return ControlExperiment(
        name="cap",
        change=f"critical wrench {critical_wrench} with the cap at {protocol.control_factor:g} rho",
        outcomes=_outcomes(outcome, wrench=[critical_wrench], phi=[grasp.rho], expected=[False], counted=[True]),
    )


def squeezes(experiment: Experiment) -> bool:
    """Whether the internal force that fingers without load take fits the planned cones."""
    contacts, margin = experiment.grasp.contacts, experiment.protocol.friction_margin
    forces, torques = FeedForward(contacts, experiment.units.reference_point).squeeze(1.0)
    utilisation = model_of(contacts).utilisation(forces, torques, contacts)
    return bool(forces.any() and (utilisation <= margin * contacts.friction).all())


def creep_control(
    outcome: Measurement, grasp: LoadedGrasp, protocol: ValidationProtocol, part: float, *, decidable: bool
) -> ControlExperiment:
    """Fingers that only squeeze must not creep; where they cannot squeeze, nor under a light load.

    Args:
        outcome: That simulation alone.
        grasp: What is measured.
        protocol: Settings.
        part: Of the critical wrench that acts; zero for no load.
        decidable: Whether what acts keeps off the friction limit.
    """
    critical_wrench = grasp.critical_wrench
    still = replace(outcome, held=outcome.held & (outcome.slip < protocol.creep_tolerance))
    load = f"these fingers cannot squeeze; {part:g} of critical wrench {critical_wrench}" if part else "no load"
    return ControlExperiment(
        name="creep",
        change=f"{load}; the slip must stay below {protocol.creep_tolerance:g} R0",
        outcomes=_outcomes(
            still,
            wrench=[critical_wrench if part else None],
            phi=[part * grasp.rho],
            expected=[True],
            counted=[decidable],
        ),
    )


def friction_control(experiment: Experiment, trial: Trial, observe: Done = lambda _: None) -> ControlExperiment:
    """With less friction in the simulator exactly the wrenches must slip whose predicted cap is then above the cap.

    The friction is lowered until theory says that some wrench is lost: a grasp that friction does not limit holds as
    before with a little less of it. The fingers do the same as before: their forces do not know the friction. What
    resists turning goes along with it, as it does for a patch.

    Args:
        experiment: With the planned contacts.
        trial: Every wrench at the cap of the verdict.
        observe: Called now and then with how many simulations are done.

    Raises:
        SimulationError: When MuJoCo stops or loses a simulation.
    """
    protocol, grasp = experiment.protocol, experiment.grasp
    cap = float(trial.caps.max()) / experiment.units.force
    factor, phi = _losing_friction(grasp, cap, protocol)
    slippery = grasp.contacts.with_friction(factor * grasp.contacts.friction)
    outcome = experiment.with_friction(slippery).perform(trial, observe)
    return ControlExperiment(
        name="friction",
        change=f"friction at {factor:.3g} of the planned, cap at {protocol.hold_factor:g} rho",
        outcomes=_outcomes(
            outcome,
            wrench=np.arange(len(grasp.wrenches)),
            phi=phi,
            expected=phi < outcome.caps,
            counted=np.abs(phi / outcome.caps - 1) > protocol.ambiguity,
        ),
    )


def _losing_friction(grasp: LoadedGrasp, cap: float, protocol: ValidationProtocol) -> tuple[float, Floats]:
    """The part of the friction at which theory says that some wrench is lost, and every wrench's phi there.

    Where none is so low, the first part that was tried: every wrench must then be held.
    """
    tried = []
    factor = protocol.friction_factor
    while factor >= protocol.least_friction:
        slippery = grasp.contacts.with_friction(factor * grasp.contacts.friction)
        tried.append((factor, predicted_caps(slippery, grasp.reference_point, grasp.wrenches)))
        if (tried[-1][1] > (1 + protocol.ambiguity) * cap).any():
            return tried[-1]
        factor *= protocol.friction_factor
    return tried[0]


def torsion_controls(experiment: Experiment, observe: Done = lambda _: None) -> tuple[ControlExperiment, ...]:
    """With fingers that resist turning less than planned, or not at all, exactly the predicted wrenches must slip.

    Sliding friction stays, so this is another patch, gamma / mu is another, and the fingers answer every wrench anew.

    Args:
        experiment: With the planned contacts, some of which have torsional friction.
        observe: Called after each with how many simulations are done.

    Raises:
        SimulationError: When MuJoCo stops or loses a simulation.
    """
    controls = []
    for factor in experiment.protocol.torsion_factors:
        controls.append(_torsion_control(experiment, factor))
        observe(len(controls) * len(experiment.grasp.wrenches))
    return tuple(controls)


def _torsion_control(experiment: Experiment, factor: float) -> ControlExperiment:
    """Every wrench with this part of the planned torsional friction.

    Without any, what is lost spins as slowly as the wrench is small; it counts only where a little torsion is no help.
    """
    protocol, planned = experiment.protocol, experiment.grasp
    weak, barely = (
        planned.with_contacts(replace(planned.contacts, torsion=part * planned.contacts.torsions))
        for part in (factor, max(factor, protocol.least_torsion))
    )
    other = replace(experiment.with_friction(weak.contacts), grasp=weak)
    outcome = other.measure(planned.wrenches, np.full(len(planned.wrenches), protocol.hold_factor))
    clear = np.all([np.abs(each.phi / outcome.caps - 1) > protocol.ambiguity for each in (weak, barely)], axis=0)
    expected = weak.phi < outcome.caps
    return ControlExperiment(
        name="torsion",
        change=f"torsional friction at {factor:g} of the planned, cap at {protocol.hold_factor:g} rho",
        outcomes=_outcomes(
            outcome,
            wrench=np.arange(len(planned.wrenches)),
            phi=weak.phi,
            expected=expected,
            counted=clear & (expected == (barely.phi < outcome.caps)),
        ),
    )


def displacement_control(planned: LoadedGrasp, protocol: ValidationProtocol) -> ControlExperiment:
    """A grasp with one contact moved must have the rho predicted for it, held just above and lost just below.

    Of all small displacements the one is taken that changes the predicted cap of the critical wrench most.

    Args:
        planned: What is measured.
        protocol: Settings.

    Raises:
        SimulationError: When the experiment cannot be built or run.
    """
    for displaced in _by_change(planned, protocol):
        grasp = planned.with_contacts(displaced.contacts)
        if not np.isfinite(grasp.rho):
            continue
        experiment = set_up(grasp, protocol)
        if experiment.static.reasons():
            continue
        worst = grasp.critical_wrench
        if grasp.friction_limited(protocol.friction_margin)[worst]:
            continue
        outcome = experiment.measure(
            grasp.wrenches[[worst, worst]], np.array([protocol.hold_factor, protocol.control_factor])
        )
        moved = f"finger {displaced.finger + 1} moved {in_mm(displaced.distance, 3)} mm"
        return ControlExperiment(
            name="displaced contact",
            change=f"{moved}, its own rho {grasp.rho:.5g} N",
            outcomes=_outcomes(
                outcome, wrench=[worst] * 2, phi=[grasp.rho] * 2, expected=[True, False], counted=[True] * 2
            ),
        )
    why = "no contact can move along its face and leave a grasp off its limits"
    return ControlExperiment(name="displaced contact", change=why, outcomes=())


def _outcomes(simulated: Measurement, **predicted: Column) -> tuple[ControlOutcome, ...]:
    """What was seen in each simulation, beside what was predicted for it: the other values of `ControlOutcome`."""
    return as_rows(
        ControlOutcome, cap=simulated.caps, slip=simulated.slip, spin=simulated.spin, held=simulated.held, **predicted
    )


def _by_change(planned: LoadedGrasp, protocol: ValidationProtocol) -> list[DisplacedGrasp]:
    """Displaced grasps that can balance the critical wrench, the one whose cap for it changed most first."""
    wrench, distance = planned.wrenches[[planned.critical_wrench]], protocol.displacement * planned.rigid_object.size
    grasps = [DisplacedGrasp(contacts=planned.contacts, finger=0, distance=0.0)]
    grasps += displaced_grasps(planned.rigid_object, planned.contacts, distance)
    caps = [predicted_caps(grasp.contacts, planned.reference_point, wrench)[0] for grasp in grasps]
    changes = np.abs(np.array(caps[1:]) - caps[0])
    return [grasps[1 + index] for index in np.argsort(-changes, kind="stable") if np.isfinite(changes[index])]
