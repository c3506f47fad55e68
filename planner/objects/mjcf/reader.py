"""Reads one rigid object from an MJCF file.

Everything is taken from the compiled model, never from the XML text: MuJoCo recentres meshes, resolves scales,
angles, default classes and included files. Frame: the chosen body's frame B, SI.
"""

import logging
from dataclasses import replace
from pathlib import Path
from zipfile import is_zipfile

import mujoco
import numpy as np

from planner.errors import ObjectError
from planner.objects.digest import digest
from planner.objects.mass_doubts import mass_doubts
from planner.objects.mjcf.compiled import CompiledObject, compile_object
from planner.objects.mjcf.file_doubts import file_doubts
from planner.objects.mjcf.mass_properties import MassProperties, combined
from planner.objects.object_source import ObjectSource
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.primitives import PRIMITIVES
from planner.objects.plausibility import size_doubts
from planner.objects.pose import Pose
from planner.objects.rigid_object import ConvexPart, RigidObject

logger = logging.getLogger(__name__)

TORSIONAL = 4
"""Contacts of this dimension (condim) and more have torsional friction."""


def read_object(source: ObjectSource | Path) -> RigidObject:
    """The rigid object of an MJCF file, as MuJoCo collides it.

    Args:
        source: How it is read; a path alone reads the only object of that file as it is. What the file includes is
            found as MuJoCo finds it.

    Returns:
        The object in the frame of its body, with the mass properties of all that is rigidly tied to it.

    Raises:
        ObjectError: If the file cannot be compiled, the body cannot be chosen, is articulated, does not collide,
            or has a geom that is no convex solid.
    """
    source = source if isinstance(source, ObjectSource) else ObjectSource(file=source)
    compiled = compile_object(source)
    for complaint in compiled.complaints:
        logger.warning("'%s' is %s", source.file, complaint)
    rigid_object = as_compiled(source, compiled)
    for doubt in [*file_doubts(compiled, rigid_object.parts), *size_doubts(rigid_object), *mass_doubts(rigid_object)]:
        logger.warning("%s", doubt)
    return rigid_object


def as_compiled(source: ObjectSource, compiled: CompiledObject) -> RigidObject:
    """The object of a file as MuJoCo compiled it, without a word about what looks doubtful.

    Its parts are the geoms `compiled.colliding`, in that order.

    Raises:
        ObjectError: If a geom is no convex solid.
    """
    parts = tuple(_part(compiled, geom) for geom in compiled.colliding)
    mass, center_of_mass, inertia = _mass_properties(compiled)
    corners = np.concatenate([part.bounds() for part in parts])
    return RigidObject(
        source=replace(source, body=compiled.body),
        sha256=digest(source.file.parent, _dependencies(source.file)),
        body=compiled.body,
        parts=parts,
        pose_in_file=compiled.pose_in_file,
        torsion=_torsion(compiled),
        untouchable=compiled.untouchable,
        mass=mass,
        center_of_mass=center_of_mass,
        inertia=inertia,
        extent=np.ptp(corners, axis=0),
        gravity=float(np.linalg.norm(compiled.model.opt.gravity)),
    ).weighing(source.given)


def _torsion(compiled: CompiledObject) -> tuple[float, ...]:
    """Torsional friction of each colliding geom [m]; empty where none has any."""
    model, geoms = compiled.model, list(compiled.colliding)
    torsion = np.where(model.geom_condim[geoms] >= TORSIONAL, model.geom_friction[geoms, 1], 0.0)
    return tuple(torsion.tolist()) if torsion.any() else ()


def _part(compiled: CompiledObject, geom: int) -> ConvexPart:
    """The convex solid of one geom, in B."""
    model, name, pose = compiled.model, compiled.geom_name(geom), compiled.geom_pose(geom)
    friction, size = float(model.geom_friction[geom, 0]), model.geom_size[geom].copy()
    if not (np.isfinite(pose.position).all() and np.isfinite(pose.quaternion).all() and np.isfinite(size).all()):
        raise ObjectError(f"geom '{name}' has a size, position or orientation that is not finite: size {size}")
    kind = mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix("mjGEOM_").lower()
    if kind == "mesh":
        return _mesh_hull(compiled, geom, name, friction)
    if kind not in PRIMITIVES:
        raise ObjectError(
            f"geom '{name}' is a {kind}, which is no convex solid; replace it by meshes, boxes, spheres, "
            "ellipsoids, cylinders or capsules, or switch its collisions off"
        )
    return PRIMITIVES[kind].placed(pose, size, geom=name, friction=friction)


def _mesh_hull(compiled: CompiledObject, geom: int, name: str, friction: float) -> Polyhedron:
    """The hull MuJoCo collides a mesh as, which `maxhullvert` may have reduced.

    Its record in `mesh_graph` starts: number of vertices v, number of faces, v edge addresses, v vertex numbers.
    """
    vertices, _ = compiled.mesh(geom)
    graph = compiled.model.mesh_graph
    start = int(compiled.model.mesh_graphadr[compiled.model.geom_dataid[geom]])
    count = int(graph[start]) if start >= 0 else 0
    on_hull = graph[start + 2 + count : start + 2 + 2 * count] if count else slice(None)
    return Polyhedron.hull(vertices[on_hull], geom=name, friction=friction)


def _mass_properties(compiled: CompiledObject) -> MassProperties:
    model, bodies = compiled.model, list(compiled.poses)
    frames = [
        pose.compose(Pose(position=model.body_ipos[body].copy(), quaternion=model.body_iquat[body].copy()))
        for body, pose in compiled.poses.items()
    ]
    return combined(model.body_mass[bodies], frames, model.body_inertia[bodies])


def _dependencies(path: Path) -> list[Path]:
    """The file itself and everything it names; an archive (.mjz) holds all of it."""
    if is_zipfile(path):
        return [path]
    try:
        return [Path(name) for name in mujoco.mju_getXMLDependencies(str(path))]
    except (mujoco.FatalError, UnicodeDecodeError) as error:
        raise ObjectError(f"MuJoCo cannot list the files '{path}' depends on: {error}") from error
