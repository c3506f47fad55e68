"""Reads one rigid object from an MJCF file: the only place where the planner meets MuJoCo.

Everything is taken from the compiled model, never from the XML text: MuJoCo recentres meshes, resolves scales,
angles, default classes and included files. Frame: the chosen body's frame B, SI.
"""

import logging
from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np

from planner.errors import ObjectError
from planner.objects.body_tree import BodyTree
from planner.objects.digest import digest
from planner.objects.mass_properties import MassProperties, combined
from planner.objects.parts.box import Box
from planner.objects.parts.capsule import Capsule
from planner.objects.parts.cylinder import Cylinder
from planner.objects.parts.ellipsoid import Ellipsoid
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.sphere import Sphere
from planner.objects.pose import Pose
from planner.objects.rigid_object import ConvexPart, RigidObject

logger = logging.getLogger(__name__)

FILLED_HOLLOW = 0.2
"""A hull whose volume exceeds its mesh's by more than this share of itself deserves a warning."""


def read_object(path: Path, body: str | None = None) -> RigidObject:
    """The rigid object of an MJCF file, as MuJoCo collides it.

    Args:
        path: The MJCF file; what it includes is found as MuJoCo finds it.
        body: Name of the body that is the object (`body<id>` where it has none); needed when the file holds
            several. Its subtree belongs to it.

    Returns:
        The object in the frame of that body, with the mass properties of the compiled subtree.

    Raises:
        ObjectError: If the file cannot be compiled, the body cannot be chosen, is articulated, does not collide,
            or has a geom that is no convex solid.
    """
    model = _compile(path)
    tree = _body_tree(model)
    if model.nflex and not tree.colliding_geoms.any():
        raise ObjectError(f"'{path}' holds flexible bodies only (flex); a rigid object is needed")
    root = tree.choose(body)
    bodies = tree.subtree(root)
    if np.isin(model.flex_vertbodyid, bodies).any():
        raise ObjectError(f"body '{tree.names[root]}' is flexible (it has a flex); a rigid object is needed")
    poses = _body_poses(model, bodies)
    geoms = [geom for geom in _colliding(model) if model.geom_bodyid[geom] in poses]
    parts = tuple(_part(model, geom, poses[model.geom_bodyid[geom]]) for geom in geoms)
    mass, center_of_mass, inertia = _mass_properties(model, poses)
    corners = np.concatenate([part.bounds() for part in parts])
    rigid_object = RigidObject(
        file=path,
        sha256=digest(path.parent, _dependencies(path)),
        body=tree.names[root],
        parts=parts,
        mass=mass,
        center_of_mass=center_of_mass,
        inertia=inertia,
        extent=np.ptp(corners, axis=0),
    )
    _warn_of_mass(rigid_object)
    return rigid_object


def _compile(path: Path) -> mujoco.MjModel:
    if not path.is_file():
        raise ObjectError(f"there is no file '{path}'; give the path of an MJCF object")
    try:
        return mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, mujoco.FatalError) as error:
        model = _compile_without_textures(path)
        if model is None:
            raise ObjectError(f"MuJoCo cannot compile '{path}': {error}") from error
        logger.warning("'%s' was compiled without its textures: %s", path, error)
        return model


def _compile_without_textures(path: Path) -> mujoco.MjModel | None:
    """The model stripped of what physics does not need, or None if that does not help."""
    try:
        spec = mujoco.MjSpec.from_file(str(path))
        if not spec.textures:
            return None
        for element in [*spec.geoms, *spec.sites, *spec.tendons]:
            element.material = ""
        for asset in [*spec.materials, *spec.textures]:
            spec.delete(asset)
        return spec.compile()
    except (ValueError, mujoco.FatalError):
        return None


def _colliding(model: mujoco.MjModel) -> Iterator[int]:
    """Geoms that MuJoCo tests for contact with others."""
    return (int(geom) for geom in np.flatnonzero(model.geom_contype | model.geom_conaffinity))


def _body_tree(model: mujoco.MjModel) -> BodyTree:
    solid = [geom for geom in _colliding(model) if model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_PLANE]
    return BodyTree(
        names=tuple(model.body(body).name or f"body{body}" for body in range(model.nbody)),
        parents=model.body_parentid,
        joints=model.body_jntnum,
        rigid_groups=model.body_weldid,
        masses=model.body_mass,
        colliding_geoms=np.bincount(model.geom_bodyid[solid], minlength=model.nbody),
    )


def _body_poses(model: mujoco.MjModel, bodies: list[int]) -> dict[int, Pose]:
    """Pose in B of each body of a subtree at qpos0, where no joint displaces anything; the root comes first."""
    root, *descendants = bodies
    poses = {root: Pose.identity()}
    for body in descendants:
        in_parent = Pose(position=model.body_pos[body].copy(), quaternion=model.body_quat[body].copy())
        poses[body] = poses[int(model.body_parentid[body])].compose(in_parent)
    return poses


def _part(model: mujoco.MjModel, geom: int, body_pose: Pose) -> ConvexPart:
    """The convex solid of one geom, in B."""
    name = model.geom(geom).name or f"geom{geom}"
    friction = float(model.geom_friction[geom, 0])
    in_body = Pose(position=model.geom_pos[geom].copy(), quaternion=model.geom_quat[geom].copy())
    pose, size = body_pose.compose(in_body), model.geom_size[geom].copy()
    if not (np.isfinite(pose.position).all() and np.isfinite(pose.quaternion).all() and np.isfinite(size).all()):
        raise ObjectError(f"geom '{name}' has a size, position or orientation that is not finite: size {size}")
    match mujoco.mjtGeom(model.geom_type[geom]):
        case mujoco.mjtGeom.mjGEOM_MESH:
            return _mesh_hull(model, int(model.geom_dataid[geom]), pose, name, friction)
        case mujoco.mjtGeom.mjGEOM_BOX:
            return Box.placed(pose, size, geom=name, friction=friction)
        case mujoco.mjtGeom.mjGEOM_SPHERE:
            return Sphere(geom=name, friction=friction, pose=pose, radius=float(size[0]))
        case mujoco.mjtGeom.mjGEOM_ELLIPSOID:
            return Ellipsoid(geom=name, friction=friction, pose=pose, semi_axes=size)
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            return Cylinder(geom=name, friction=friction, pose=pose, radius=float(size[0]), half_length=float(size[1]))
        case mujoco.mjtGeom.mjGEOM_CAPSULE:
            return Capsule(geom=name, friction=friction, pose=pose, radius=float(size[0]), half_length=float(size[1]))
        case other:
            kind = other.name.removeprefix("mjGEOM_").lower()
            raise ObjectError(
                f"geom '{name}' is a {kind}, which is no convex solid; replace it by meshes, boxes, spheres, "
                "ellipsoids, cylinders or capsules, or switch its collisions off"
            )


def _mesh_hull(model: mujoco.MjModel, mesh: int, pose: Pose, name: str, friction: float) -> Polyhedron:
    """The hull MuJoCo collides a mesh as, which `maxhullvert` may have reduced.

    Its record in `mesh_graph` starts: number of vertices v, number of faces, v edge addresses, v vertex numbers.
    """
    first, start = model.mesh_vertadr[mesh], int(model.mesh_graphadr[mesh])
    vertices = pose.to_body(model.mesh_vert[first : first + model.mesh_vertnum[mesh]].astype(float))
    count = int(model.mesh_graph[start]) if start >= 0 else 0
    on_hull = model.mesh_graph[start + 2 + count : start + 2 + 2 * count] if count else slice(None)
    hull = Polyhedron.hull(vertices[on_hull], geom=name, friction=friction)
    first_face = model.mesh_faceadr[mesh]
    faces = model.mesh_face[first_face : first_face + model.mesh_facenum[mesh]]
    filled = 1 - abs(_volume(vertices[faces])) / _volume(hull.triangles()[0])
    if filled > FILLED_HOLLOW:
        logger.warning(
            "geom '%s' collides as its convex hull, %.0f %% of which is outside its mesh; decompose the mesh into "
            "convex parts if fingers should reach into its hollows",
            name,
            100 * filled,
        )
    return hull


def _volume(triangles: np.ndarray) -> float:
    """Signed volume inside a closed surface (divergence theorem), from its triangles, shape (n, 3, 3) [m^3]."""
    arms = triangles - triangles[0, 0]
    return float((arms[:, 0] * np.cross(arms[:, 1], arms[:, 2])).sum() / 6)


def _mass_properties(model: mujoco.MjModel, poses: dict[int, Pose]) -> MassProperties:
    bodies = list(poses)
    frames = [
        poses[body].compose(Pose(position=model.body_ipos[body].copy(), quaternion=model.body_iquat[body].copy()))
        for body in bodies
    ]
    return combined(model.body_mass[bodies], frames, model.body_inertia[bodies])


def _dependencies(path: Path) -> list[Path]:
    """The file itself and everything it names."""
    try:
        return [Path(name) for name in mujoco.mju_getXMLDependencies(str(path))]
    except mujoco.FatalError as error:
        raise ObjectError(f"MuJoCo cannot list the files '{path}' depends on: {error}") from error


def _warn_of_mass(rigid_object: RigidObject) -> None:
    """Mass properties that are allowed here and wrong almost everywhere else."""
    name, mass = rigid_object.body, rigid_object.mass
    if mass <= 0:
        logger.warning("body '%s' has no mass; tasks that need its weight will refuse it", name)
    elif np.linalg.eigvalsh(rigid_object.inertia)[-1] > mass * rigid_object.size**2:
        logger.warning("the inertia of body '%s' is too large for its mass and size; is it a placeholder?", name)
