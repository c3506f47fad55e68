"""Are the wrenches those that the task's name or file asks for on this object?"""

import numpy as np

from planner.errors import ObjectError, TaskError
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable
from planner.task import Task, make_task
from planner.verification.check import Check, checked, not_checked
from planner.verification.provenance.mass import NO_OBJECT
from planner.wrench_sets.presets import PRESETS

AGREEMENT = 1e-6
"""Relative accuracy of forces, of moments, and of the reference point by the object's size."""


def check_task(grasp: Grasp, rigid_object: Graspable | None) -> Check:
    """The task is made again from its preset or file, and compared.

    A task that says neither but bears the name of a preset claims to be that preset.
    """
    task = grasp.task
    preset = task.preset or (task.name if task.name in PRESETS and task.file is None else None)
    if preset is not None:
        choice, claim = preset, f"the task is the preset '{preset}' of this object"
        if preset not in PRESETS:
            return checked(claim, False, f"there are the presets {', '.join(PRESETS)}")
    elif task.file is not None:
        choice, claim = task.file.path, f"the task '{task.name}' is that of {task.file.path}"
        if not task.file.there:
            return not_checked(claim, "the file is not there")
    else:
        claim = f"the {len(task.wrenches)} wrenches of the task '{task.name}' are the ones that matter"
        return not_checked(claim, "it names neither preset nor task file: they are the caller's own")
    if rigid_object is None:
        return not_checked(claim, NO_OBJECT)
    return _compared(claim, task, choice, rigid_object)


def _compared(claim: str, task: Task, choice: str, rigid_object: Graspable) -> Check:
    """The task against what a preset or file asks for now."""
    changed = "the file has changed since; " if task.file is not None and not task.file.unchanged else ""
    try:
        again = make_task(choice, rigid_object)
    except (TaskError, ObjectError) as error:
        return checked(claim, False, f"{changed}{error}")
    if task.name != again.name:
        return checked(claim, False, f"{changed}the name is '{task.name}', it should be '{again.name}'")
    if task.wrenches.shape != again.wrenches.shape:
        wrenches = f"{len(task.wrenches)} wrenches instead of {len(again.wrenches)}"
        return checked(claim, False, f"{changed}it has {wrenches}")
    dimension = rigid_object.extent.size
    shift = float(np.abs(task.reference_point - again.reference_point).max())
    differences = [
        float(np.abs(stated - asked).max()) / (float(np.abs(asked).max()) or 1.0)
        for stated, asked in zip(
            np.split(task.wrenches, [dimension], axis=1), np.split(again.wrenches, [dimension], axis=1), strict=True
        )
    ]
    if max(differences) <= AGREEMENT and shift <= AGREEMENT * rigid_object.size:
        return checked(claim, True, f"{changed}made again: the same {len(task.wrenches)} wrenches")
    return checked(
        claim,
        False,
        f"{changed}its forces differ by {differences[0]:.2g} of the largest that are asked for, its moments by "
        f"{differences[1]:.2g}, its reference point by {shift:.2g} m",
    )
