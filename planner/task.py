"""The task: which wrenches a grasp must resist, about which point.

Chosen by the name of a preset or by a TOML file:

    name = "screwdriver"               # the file's name where left out
    frame = "body"                     # or "world", where the object's file places the body; body where left out
    reference_point = [0, 0, 0.02]     # in that frame [m]; the centre of mass where left out

    [set]
    kind = "cylinder"                  # a name of KINDS or of PRESETS; the other keys are its fields
    force = 5.0
    moment = 0.1

The set's axes are those of the frame. A planned task is always in the body frame B.
"""

import logging
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import msgspec
import numpy as np

from planner.arrays import Floats
from planner.contacts import wrench_dimension
from planner.errors import TaskError
from planner.files.source_file import SourceFile, source_file
from planner.files.toml_file import read_toml
from planner.objects.graspable import Graspable
from planner.objects.plausibility import gravity_doubts
from planner.objects.pose import Pose
from planner.objects.rigid_object import RigidObject
from planner.wrench_sets.by_name import KINDS
from planner.wrench_sets.circumscribed import MAX_VERTICES
from planner.wrench_sets.presets import GRAVITY, PRESETS, Axes6, Preset
from planner.wrench_sets.values import finite_vector
from planner.wrench_sets.wrench_set import WrenchSet

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False, kw_only=True)
class Task:
    """The required external force set of one object as a polytope.

    Raises:
        TaskError: On shapes that do not match, values that are not finite, too many vertices, or no vertex
            but zero.
    """

    name: str

    reference_point: Floats
    """p_o, about which moments are taken, in the body frame, shape (d,) [m]."""

    wrenches: Floats
    """Vertices of W_R in the body frame, shape (l, D) [N, N m]."""

    preset: str | None = None
    """The preset that it is, where it was chosen by that name."""

    file: SourceFile | None = None
    """The task file that it was read from. With neither preset nor file, the wrenches are the caller's own."""

    def __post_init__(self) -> None:
        dimension = len(finite_vector("reference_point", self.reference_point.tolist(), (2, 3)))
        shape = self.wrenches.shape
        if self.wrenches.ndim != 2 or shape[1] != wrench_dimension(dimension) or not shape[0]:
            raise TaskError(
                f"the task's wrenches have shape {shape}; about a point of {dimension} coordinates expected "
                f"(1 or more, {wrench_dimension(dimension)})"
            )
        if shape[0] > MAX_VERTICES:
            raise TaskError(f"the task has {shape[0]} wrenches; at most {MAX_VERTICES} are allowed: use fewer facets")
        if not np.isfinite(self.wrenches).all():
            raise TaskError("a wrench of the task is not finite")
        if not self.wrenches.any():
            raise TaskError("every wrench of the task is zero: there is nothing to resist")


PRESET_HINT = f"; the presets {', '.join(PRESETS)} need no file"

SAMPLES = {
    2: '; a whole task file can be: set = {kind = "single", wrench = [0, -5, 0]}  # N, N, N m',
    3: '; a whole task file can be: set = {kind = "single", wrench = [0, 0, -5, 0, 0, 0]}  # N, N, N, N m, N m, N m',
}
"""What ends a complaint about a task file, in the plane and in space."""


class TaskFile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A task file, before its set is known."""

    set: dict[str, Any]
    name: str | None = None
    frame: Literal["body", "world"] = "body"
    reference_point: tuple[float, ...] | None = None


def make_task(choice: str, object: Graspable) -> Task:
    """The task for one object.

    Args:
        choice: Name of a preset, or path of a TOML file.
        object: The object; presets take its weight and size.

    Raises:
        TaskError: When there is no such preset or file, or it is broken, or its set does not fit the object.
    """
    center = object.center_of_mass
    if choice in PRESETS:
        preset = _preset(PRESETS[choice](), object, center)
        return Task(name=choice, reference_point=center, wrenches=preset.vertices(), preset=choice)
    sample = SAMPLES[len(center)]
    file = read_toml(Path(choice), TaskFile, "task file", TaskError, PRESET_HINT + sample, sample)
    try:
        pose = _stated_frame(file, object)
        stated = file.reference_point
        point = center if stated is None else _point(pose, finite_vector("reference_point", stated, (len(center),)))
        wrenches = _turned(pose, _wrench_set(file.set, object, point).vertices())
        name = file.name or Path(choice).stem
        return Task(name=name, reference_point=point, wrenches=wrenches, file=source_file(Path(choice)))
    except TaskError as error:
        raise TaskError(f"task file {choice}: {error}{sample}") from error


def _preset(preset: Preset, object: Graspable, point: Floats) -> WrenchSet:
    """Its set for one object; those that take the weight say where the object's file has another gravity."""
    if not isinstance(preset, Axes6):
        for doubt in gravity_doubts(object.gravity, GRAVITY):
            logger.warning("%s", doubt)
    return preset.for_object(object, point)


def _stated_frame(file: TaskFile, object: Graspable) -> Pose | None:
    """The pose of the body in the frame F that the file states, X_FB; None where that is the body's own."""
    if file.frame == "body":
        return None
    if not isinstance(object, RigidObject):
        raise TaskError('frame = "world" is for objects that a file places in space; a planar object has only its own')
    return object.pose_in_file


def _point(pose: Pose | None, point: Floats) -> Floats:
    """A point of F, shape (d,), in B [m]."""
    return point if pose is None else pose.to_local(point)


def _turned(pose: Pose | None, wrenches: Floats) -> Floats:
    """Wrenches about one point from the axes of F to those of B, shape (l, D): R_BF f, R_BF m."""
    if pose is None or wrenches.shape[1] != 6:  # a set for the plane is refused where its shape is checked
        return wrenches
    rows: Floats = wrenches.reshape(-1, 2, 3) @ pose.rotation
    return rows.reshape(-1, 6)


def _wrench_set(table: dict[str, Any], object: Graspable, point: Floats) -> WrenchSet:
    """The set that the table of a task file describes, for one object and reference point."""
    kind = table.get("kind")
    if not isinstance(kind, str) or kind not in KINDS | PRESETS:
        raise TaskError(f"set.kind is {kind!r}; allowed: {', '.join(KINDS | PRESETS)}")
    fields = {key: value for key, value in table.items() if key != "kind"}
    try:
        if kind in PRESETS:
            return _preset(msgspec.convert(fields, PRESETS[kind]), object, point)
        return msgspec.convert(fields, KINDS[kind])
    except msgspec.ValidationError as error:
        message = str(error) if "`$" in str(error) else f"{error} - at `$`"
        raise TaskError(message.replace("`$", "`$.set")) from error
