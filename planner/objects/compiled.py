"""An MJCF file as MuJoCo compiles it, and the body of it that is the object.

Frame: the chosen body's frame B, SI.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from planner.errors import ObjectError
from planner.objects.body_tree import BodyTree
from planner.objects.bounded_compile import compile_bounded
from planner.objects.pose import Pose

REFUSALS = (ValueError, mujoco.FatalError, mujoco.UnexpectedError)
"""What MuJoCo's parser and compiler raise; the last where there is no memory for a field of heights."""


def _as_it_is(_: mujoco.MjSpec) -> None:
    """Change nothing."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CompiledObject:
    """One body of a compiled model with everything that is rigidly attached to it."""

    model: mujoco.MjModel

    body: str
    """Name of the body, `body<id>` where it has none."""

    poses: dict[int, Pose]
    """Pose in B of each of the object's bodies at qpos0; the root, B itself, comes first."""

    colliding: tuple[int, ...]
    """Geoms of the object that MuJoCo tests for contact with others."""

    def geom_name(self, geom: int) -> str:
        """Its name, or `geom<id>` where it has none."""
        return self.model.geom(geom).name or f"geom{geom}"

    def geom_pose(self, geom: int) -> Pose:
        """X_BG."""
        in_body = Pose(position=self.model.geom_pos[geom].copy(), quaternion=self.model.geom_quat[geom].copy())
        return self.poses[int(self.model.geom_bodyid[geom])].compose(in_body)

    def meshes(self, *, colliding: bool) -> list[int]:
        """The object's mesh geoms that collide, or those that are only seen."""
        is_mesh = self.model.geom_type == mujoco.mjtGeom.mjGEOM_MESH
        mine = np.isin(self.model.geom_bodyid, list(self.poses))
        chosen = np.isin(np.arange(self.model.ngeom), self.colliding)
        return [int(geom) for geom in np.flatnonzero(is_mesh & mine & (chosen == colliding))]

    def mesh(self, geom: int) -> tuple[np.ndarray, np.ndarray]:
        """Vertices in B, shape (n, 3) [m], and triangles of vertex numbers, shape (faces, 3), of a mesh geom.

        MuJoCo recentres meshes: its vertices belong to its pose, those of the file to nothing in the model.
        """
        model, mesh = self.model, int(self.model.geom_dataid[geom])
        vertices = model.mesh_vert[model.mesh_vertadr[mesh] :][: model.mesh_vertnum[mesh]]
        faces = model.mesh_face[model.mesh_faceadr[mesh] :][: model.mesh_facenum[mesh]]
        return self.geom_pose(geom).to_body(vertices.astype(float)), faces


def compile_mjcf(path: Path, change: Callable[[mujoco.MjSpec], None] = _as_it_is) -> tuple[mujoco.MjModel, str]:
    """The model of a file, and MuJoCo's complaint where it could only be compiled without textures.

    Args:
        path: The MJCF file; what it includes is found as MuJoCo finds it.
        change: Applied to the parsed file before it is compiled.

    Raises:
        ObjectError: If there is no such file, or MuJoCo cannot compile it within the limits of `bounded_compile`.
    """
    return compile_bounded(path, lambda: _compile(path, change))


def _compile(path: Path, change: Callable[[mujoco.MjSpec], None]) -> tuple[mujoco.MjModel, str]:
    """The same without limits."""
    try:
        spec = mujoco.MjSpec.from_file(str(path))
        change(spec)
        return _compiled(spec), ""
    except REFUSALS as error:
        model = _compile_without_textures(path, change)
        if model is None:
            raise ObjectError(f"MuJoCo cannot compile '{path}': {error}") from error
        return model, str(error)


def _compile_without_textures(path: Path, change: Callable[[mujoco.MjSpec], None]) -> mujoco.MjModel | None:
    """The model stripped of what physics does not need, or None if that does not help."""
    try:
        spec = mujoco.MjSpec.from_file(str(path))
        if not spec.textures:
            return None
        for element in [*spec.geoms, *spec.sites, *spec.tendons]:
            element.material = ""
        for asset in [*spec.materials, *spec.textures]:
            spec.delete(asset)
        change(spec)
        return _compiled(spec)
    except REFUSALS:
        return None


def _compiled(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """Its model; advice of the compiler on simulating it (flexible bodies, attached options) is not ours to give."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return spec.compile()


def choose_object(model: mujoco.MjModel, body: str | None) -> CompiledObject:
    """The object of a model: the body asked for, or the only one it can be, with its subtree.

    Raises:
        ObjectError: If the body cannot be chosen, is articulated, flexible, or does not collide.
    """
    tree = body_tree(model)
    if model.nflex and not tree.colliding_geoms.any():
        raise ObjectError("the file holds flexible bodies only (flex); a rigid object is needed")
    root = tree.choose(body)
    bodies = tree.subtree(root)
    if np.isin(model.flex_vertbodyid, bodies).any():
        raise ObjectError(f"body '{tree.names[root]}' is flexible (it has a flex); a rigid object is needed")
    colliding = _collides(model) & np.isin(model.geom_bodyid, bodies)
    return CompiledObject(
        model=model,
        body=tree.names[root],
        poses=_body_poses(model, bodies),
        colliding=tuple(int(geom) for geom in np.flatnonzero(colliding)),
    )


def body_tree(model: mujoco.MjModel) -> BodyTree:
    """The bodies of a model."""
    solid = _collides(model) & (model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE)
    return BodyTree(
        names=tuple(model.body(body).name or f"body{body}" for body in range(model.nbody)),
        parents=model.body_parentid,
        joints=model.body_jntnum,
        rigid_groups=model.body_weldid,
        masses=model.body_mass,
        colliding_geoms=np.bincount(model.geom_bodyid[solid], minlength=model.nbody),
    )


def _collides(model: mujoco.MjModel) -> np.ndarray:
    """Which geoms MuJoCo tests for contact with others, shape (geoms,); names and groups do not matter."""
    return (model.geom_contype | model.geom_conaffinity) != 0


def _body_poses(model: mujoco.MjModel, bodies: list[int]) -> dict[int, Pose]:
    """Pose in B of each body of a subtree at qpos0, where no joint displaces anything."""
    root, *descendants = bodies
    poses = {root: Pose.identity()}
    for body in descendants:
        in_parent = Pose(position=model.body_pos[body].copy(), quaternion=model.body_quat[body].copy())
        poses[body] = poses[int(model.body_parentid[body])].compose(in_parent)
    return poses
