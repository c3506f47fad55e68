"""The tests that `grasp-validate --mode` chooses from: what each runs, writes and says."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from planner.files.json_document import finite_or_none
from planner.grasps.grasp import Grasp
from planner.millimetres import in_mm
from planner.objects.rigid_object import RigidObject
from planner.progress import Observe
from sim.benches.bench import BenchOutcome
from sim.benches.dexgraspbench import dexgraspbench
from sim.benches.document import write_bench
from sim.benches.graspdatagen import graspdatagen
from sim.commands.validation_report import validation_lines, validation_summary
from sim.squeeze.document import write_squeeze
from sim.squeeze.squeeze import SqueezeForce, measure_squeeze_force
from sim.trial.loaded_grasp import LoadedGrasp
from sim.trial.protocol import active_protocol
from sim.validation.document import write_validation
from sim.validation.validation import validate

if TYPE_CHECKING:
    from sim.commands.validate import Options


@dataclass(frozen=True, eq=False, kw_only=True)
class Outcome:
    """What a test leaves: its verdict, its file and its words."""

    passed: bool
    write: Callable[[Path], None]
    lines: list[str]

    summary: dict[str, Any]
    """The same in numbers, for scripts; forces in [N]."""


Test = Callable[[RigidObject, Grasp, "Options", Observe], Outcome]


def active(rigid_object: RigidObject, grasp: Grasp, options: "Options", observe: Observe) -> Outcome:
    """Forces that adapt to every wrench, capped around rho."""
    validation = validate(
        rigid_object,
        grasp,
        active_protocol(grasp.contacts, strict=options.strict),
        measure=options.measure or options.thorough,
        thorough=options.thorough,
        observe=observe,
    )
    return Outcome(
        passed=bool(validation.verdict),
        write=lambda out: write_validation(out, validation, grasp=options.file.name),
        lines=validation_lines(validation),
        summary=validation_summary(validation),
    )


def squeeze(rigid_object: RigidObject, grasp: Grasp, options: "Options", observe: Observe) -> Outcome:
    """A constant squeeze that must hold every wrench, without adapting."""
    need = measure_squeeze_force(LoadedGrasp.of(rigid_object, grasp), observe=observe)
    return Outcome(
        passed=need.confirmed,
        write=lambda out: write_squeeze(out, need, rigid_object, rho=grasp.rho, grasp=options.file.name),
        lines=[
            f"squeeze     predicted {need.predicted.squeeze_force:.6g} N, "
            f"measured {need.lower:.6g} to {need.upper:.6g} N"
            if need.predicted.feasible
            else "squeeze     no constant squeeze can hold this load; nothing was measured",
            f"            not rho: fingers that adapt need {grasp.rho:.6g} N",
            f"verdict     {_squeeze_verdict(need)} ({need.protocol.name})",
        ],
        summary={
            "holdable": need.predicted.feasible,
            "squeeze_force": need.predicted.squeeze_force if need.predicted.feasible else None,
            "measured_lower": need.lower if need.predicted.feasible else None,
            "measured_upper": finite_or_none(need.upper),
            "rho": grasp.rho,
        },
    )


def _squeeze_verdict(need: SqueezeForce) -> str:
    if not need.predicted.feasible:
        return "NO CONSTANT SQUEEZE HOLDS"
    return "CONFIRMED" if need.confirmed else "NOT CONFIRMED"


def bench(
    run: Callable[..., BenchOutcome],
    rigid_object: RigidObject,
    grasp: Grasp,
    options: "Options",
    _: Observe,
) -> Outcome:
    """Another project's tugs and thresholds."""
    outcome = run(rigid_object, grasp.contacts, grasp.rho if options.squeeze is None else options.squeeze)
    return Outcome(
        passed=outcome.passed,
        write=lambda out: write_bench(out, outcome, grasp=options.file.name),
        lines=[
            f"bench       fingertips squeeze with {outcome.squeeze:.5g} N; the object moved at most "
            f"{in_mm(outcome.translations.max(), 3)} mm and turned {np.rad2deg(outcome.rotations.max()):.3g} degrees",
            f"verdict     {'PASS' if outcome.passed else 'FAIL'} ({outcome.settings.name}); this is not about rho",
            *(f"because     {reason}" for reason in outcome.reasons),
        ],
        summary={
            "reasons": outcome.reasons,
            "squeeze": outcome.squeeze,
            "largest_translation": float(outcome.translations.max()),
            "largest_rotation": float(outcome.rotations.max()),
        },
    )


MODES: dict[str, tuple[str, Test]] = {
    "active": (".validation.json", active),
    "squeeze": (".squeeze.json", squeeze),
    "dexgraspbench": (".bench.json", partial(bench, dexgraspbench)),
    "graspdatagen": (".bench.json", partial(bench, graspdatagen)),
}
"""Mode, the ending of its file, and its test."""
