"""One verb: measure in MuJoCo whether a grasp's rho is true.

With the cap slightly above rho every wrench must be held. Beside the verdict stand the control experiments: with the
cap slightly below rho, with less friction or with another contact the experiment must fail where theory says, and
without load it must not creep.
"""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats, Mask
from planner.files.package_versions import package_versions
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable
from planner.progress import Observe
from sim.scene.static_check import StaticCheck
from sim.trial.experiment import Experiment, set_up
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.measurement import Measurement
from sim.trial.protocol import ValidationProtocol
from sim.trial.workload import Workload
from sim.validation.beyond import SIMULATIONS, Loads, measure_beyond
from sim.validation.control_experiment import ControlExperiment
from sim.validation.control_experiments import (
    cap_control,
    creep_control,
    displacement_control,
    friction_control,
    squeezes,
    torsion_controls,
)
from sim.validation.critical_force import CriticalForce, bisect_caps, expected_simulations
from sim.validation.force_agreement import ForceAgreement, force_agreement
from sim.validation.verdict import Verdict, judge, undecided, unheld

LIGHT = 0.5
"""Part of the critical wrench under which fingers that cannot squeeze must not creep."""
FEW = 4
"""Simulations of the controls beside those that run every wrench again."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Validation:
    """Verdict, evidence and the settings under which it was gathered."""

    verdict: Verdict
    """Whether rho is confirmed, refuted, or the experiment not to be trusted."""

    reasons: tuple[str, ...]
    """Why rho is not confirmed, one sentence each; empty when it is."""

    grasp: LoadedGrasp
    """What was measured."""

    simulated_friction: Floats
    """Shape (contacts,)."""

    simulated_torsion: Floats
    """Shape (contacts,) [m]."""

    static: StaticCheck
    """Whether the fingertips touch what was planned; if not, nothing was simulated."""

    limited: Mask
    """Which wrenches lie on the friction limit, shape (wrenches,): whatever the cap, they need nearly all of it."""

    vertices: Measurement | None
    """Every wrench with the cap above rho, in order."""

    forces: ForceAgreement | None
    """Predicted against measured forces of `vertices`."""

    controls: tuple[ControlExperiment, ...]
    """What shows that the experiment can be believed; empty if nothing was simulated."""

    critical_force: CriticalForce | None
    """Measured cap of every wrench, if asked for."""

    beyond: tuple[Loads, ...]
    """Loads other than the vertices; empty if not asked for."""

    protocol: ValidationProtocol

    versions: dict[str, str]
    """Of the packages that can change the outcome."""


def validate(
    rigid_object: Graspable,
    grasp: Grasp,
    protocol: ValidationProtocol | None = None,
    *,
    measure: bool = False,
    thorough: bool = False,
    observe: Observe = lambda *_: None,
) -> Validation:
    """Validate a planned grasp with the friction it was planned with; see `validate_contacts`.

    Args:
        rigid_object: What the fingers hold.
        grasp: With contacts; of a planar object, validated as a slab.
        protocol: Settings and thresholds; by default those for such contacts, `active_protocol`.
        measure: Bisect the cap of every wrench too.
        thorough: Load the grasp with more than the vertices too.
        observe: Told now and then how many simulations are done, and of how many.

    Raises:
        SimulationError: When there are no contacts, or the experiment cannot be built or run as described.
    """
    return validate_contacts(
        LoadedGrasp.of(rigid_object, grasp), protocol, measure=measure, thorough=thorough, observe=observe
    )


def validate_contacts(
    grasp: LoadedGrasp,
    protocol: ValidationProtocol | None = None,
    simulated_friction: Floats | None = None,
    *,
    measure: bool = False,
    thorough: bool = False,
    observe: Observe = lambda *_: None,
) -> Validation:
    """Measure whether the grasp holds every wrench just above rho, in an experiment whose controls behave.

    Args:
        grasp: What is measured.
        protocol: Settings and thresholds; by default those for such contacts, `active_protocol`.
        simulated_friction: Friction in the simulator, shape (contacts,), with the torsional friction that goes with
            it; the planned one if None.
        measure: Bisect the cap of every wrench too.
        thorough: Load the grasp with more than the vertices too.
        observe: Told now and then how many simulations are done, and of how many.

    Raises:
        SimulationError: When the experiment cannot be built or run as described.
    """
    if measure:
        grasp.require_predictions()
    experiment = set_up(grasp, protocol, simulated_friction)
    protocol, simulated = experiment.protocol, experiment.scene.contacts
    limited = grasp.friction_limited(protocol.friction_margin)
    objections: tuple[str, ...] = experiment.static.reasons()
    doubts: tuple[str, ...] = ()
    vertices = critical_force = None
    beyond: tuple[Loads, ...] = ()
    controls: tuple[ControlExperiment, ...] = ()
    if not objections:
        count = len(grasp.wrenches)
        twisting = len(protocol.torsion_factors) * count if grasp.contacts.torsions.any() else 0
        work = Workload(observe, twisting + _expected(count, measure=measure, thorough=thorough))
        holding = work.part("holding every wrench", count)
        trial = experiment.active(grasp.wrenches, np.full(count, protocol.hold_factor))
        vertices = experiment.perform(trial, holding)
        controls = (
            *_simple_controls(experiment, limited=bool(limited[grasp.critical_wrench])),
            friction_control(experiment, trial, work.part("controls", count + FEW)),
            displacement_control(grasp, protocol),
            *(torsion_controls(experiment, work.part("controls of torsion", twisting)) if twisting else ()),
        )
        objections = unheld(vertices, limited, protocol.reach / experiment.units.length, protocol)
        if measure:
            part = work.part("bisecting the cap of every wrench", expected_simulations(count))
            critical_force = bisect_caps(experiment, part)
        if thorough:
            beyond = measure_beyond(experiment, observe=work.part("loads beyond the vertices", SIMULATIONS))
        objections += tuple(objection for loads in beyond if (objection := loads.objection()))
        raised = [*(control.doubt() for control in controls), *(loads.doubt() for loads in beyond)]
        doubts = undecided(vertices, limited, protocol) + tuple(filter(None, raised))
    return Validation(
        verdict=judge(objections, doubts),
        reasons=objections + doubts,
        grasp=grasp,
        simulated_friction=simulated.friction,
        simulated_torsion=simulated.torsions / experiment.units.length,
        static=experiment.static,
        limited=limited,
        vertices=vertices,
        forces=force_agreement(vertices, simulated.friction, grasp.contacts.strengths) if vertices else None,
        controls=controls,
        critical_force=critical_force,
        beyond=beyond,
        protocol=protocol,
        versions=package_versions(),
    )


def _expected(wrenches: int, *, measure: bool, thorough: bool) -> int:
    """Simulations of a validation."""
    return 2 * wrenches + FEW + (expected_simulations(wrenches) if measure else 0) + (SIMULATIONS if thorough else 0)


def _simple_controls(experiment: Experiment, *, limited: bool) -> tuple[ControlExperiment, ControlExperiment]:
    """Less cap and no load: two more simulations of the same experiment."""
    protocol, grasp = experiment.protocol, experiment.grasp
    part, critical = 0.0 if squeezes(experiment) else LIGHT, grasp.wrenches[grasp.critical_wrench]
    outcome = experiment.measure(
        np.vstack([critical, part * critical]), np.array([protocol.control_factor, protocol.hold_factor])
    )
    return (
        cap_control(outcome.rows(slice(0, 1)), grasp, protocol),
        creep_control(outcome.rows(slice(1, 2)), grasp, protocol, part, decidable=not (part and limited)),
    )
