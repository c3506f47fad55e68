"""An MJCF file as MuJoCo compiles it, and the body of it that is the object.

Frame: the chosen body's frame B, SI.
"""

import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import mujoco
import numpy as np

from planner.arrays import Floats, Indices
from planner.errors import MasslessError, ObjectError
from planner.objects.digest import digest
from planner.objects.mjcf.appearance import MASSLESS, advice, without_culprit
from planner.objects.mjcf.body_poses import body_poses, configuration_at, poses_in_world
from planner.objects.mjcf.bounded_compile import compile_bounded
from planner.objects.mjcf.collides import collides
from planner.objects.mjcf.compile_effort import named_files, require_moderate
from planner.objects.mjcf.mesh_file import refuse_mesh
from planner.objects.mjcf.model_tree import body_tree
from planner.objects.mjcf.names import name_at
from planner.objects.mjcf.obj_file import ObjFile, is_obj, read_obj
from planner.objects.mjcf.uniform_density import weigh_massless_bodies
from planner.objects.object_source import ObjectSource
from planner.objects.pose import Pose

REFUSALS = (ValueError, mujoco.FatalError, mujoco.UnexpectedError)
"""What MuJoCo's parser and compiler raise; the last where there is no memory for a field of heights."""


_latest: dict[tuple[Path, Path, str], tuple[mujoco.MjModel, tuple[str, ...]]] = {}
"""The last file compiled as it is, by its path as given, its absolute path and the digest of all that it names: the
steps of a command ask for the same object."""


def _as_it_is(_: mujoco.MjSpec) -> None:
    """Change nothing."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CompiledObject:
    """One body of a compiled model with everything that is rigidly attached to it."""

    model: mujoco.MjModel

    complaints: tuple[str, ...]
    """What was left out to compile it, and why."""

    body: str
    """Name of the body, `body<id>` where it has none."""

    poses: dict[int, Pose]
    """Pose in B of each of the object's bodies at `configuration`; that of B itself comes first."""

    pose_in_file: Pose
    """X_WB at `configuration`: where the file places the body in its world W."""

    configuration: Floats
    """Coordinates of the model's joints, qpos, at which the object is rigid, shape (nq,)."""

    colliding: tuple[int, ...]
    """Geoms of the object that MuJoCo tests for contact with others."""

    untouchable: frozenset[int]
    """Those of them, by their places in `colliding`, that are not of the body which fingers may touch."""

    def geom_name(self, geom: int) -> str:
        """Its name, or `geom<id>` where it has none."""
        return name_at(self.model, self.model.name_geomadr, geom, "geom")

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

    def mesh(self, geom: int) -> tuple[Floats, Indices]:
        """Vertices in B, shape (n, 3) [m], and triangles of vertex numbers, shape (faces, 3), of a mesh geom.

        MuJoCo recentres meshes: its vertices belong to its pose, those of the file to nothing in the model. Faces that
        MuJoCo leaves out, see `partly_read`, are among the triangles.
        """
        model, mesh = self.model, int(self.model.geom_dataid[geom])
        vertices = model.mesh_vert[model.mesh_vertadr[mesh] :][: model.mesh_vertnum[mesh]]
        faces = model.mesh_face[model.mesh_faceadr[mesh] :][: model.mesh_facenum[mesh]]
        if mesh in self.partly_read:
            faces = self.partly_read[mesh].faces
            faces = faces[:, ::-1] if model.mesh_scale[mesh].prod() < 0 else faces
        return self.geom_pose(geom).to_body(vertices.astype(float)), faces

    @cached_property
    def partly_read(self) -> dict[int, ObjFile]:
        """The object's meshes, by number, whose OBJ file has more faces than MuJoCo reads: those of one group."""
        geoms = [*self.meshes(colliding=True), *self.meshes(colliding=False)]
        found = {}
        for mesh in dict.fromkeys(int(self.model.geom_dataid[geom]) for geom in geoms):
            path = self._mesh_path(mesh)
            file = read_obj(path) if is_obj(path) else None
            if (
                file is not None
                and len(file.faces) > self.model.mesh_facenum[mesh]
                and file.vertices == self.model.mesh_vertnum[mesh]
            ):
                found[mesh] = file
        return found

    @property
    def parts_of_several_groups(self) -> list[int]:
        """Places in `colliding` of the mesh geoms that are read in part."""
        meshes = {geom: int(self.model.geom_dataid[geom]) for geom in self.meshes(colliding=True)}
        return [self.colliding.index(geom) for geom, mesh in meshes.items() if mesh in self.partly_read]

    def _mesh_path(self, mesh: int) -> Path:
        start = int(self.model.mesh_pathadr[mesh])
        if start < 0:
            return Path()
        return Path(os.fsdecode(self.model.paths[start : self.model.paths.index(b"\0", start)]))


def compile_mjcf(
    path: Path, change: Callable[[mujoco.MjSpec], None] = _as_it_is
) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """The model of a file, and what had to be left out of what is only seen.

    Bodies that the file asks to be fused, and geoms that it asks to be discarded, are kept. A file that is asked for
    again as it is, and has not changed, is not compiled again: do not change its model.

    Args:
        path: The MJCF file; what it includes is found as MuJoCo finds it.
        change: Applied to the parsed file before it is compiled.

    Raises:
        ObjectError: If there is no such file, it asks for too much, or MuJoCo cannot compile it within the limits of
            `bounded_compile`.
    """
    refuse_mesh(path)
    require_moderate(path)
    if change is not _as_it_is:
        return compile_bounded(path, lambda: _compile(path, change))
    read = path, path.absolute(), digest(path.parent, named_files(path))
    if read not in _latest:
        compiled = compile_bounded(path, lambda: _compile(path, change))
        _latest.clear()
        _latest[read] = compiled
    return _latest[read]


def _compile(path: Path, change: Callable[[mujoco.MjSpec], None]) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """The same without limits."""
    left_out: list[str] = []
    try:
        spec = mujoco.MjSpec.from_file(str(path))
        spec.compiler.fusestatic = spec.compiler.discardvisual = False
        change(spec)
        while True:
            try:
                return _compiled(spec), tuple(left_out)
            except REFUSALS as error:
                remedy = without_culprit(spec, str(error))
                if remedy is None:
                    raise
                left_out.append(remedy)
    except REFUSALS as error:
        kind = MasslessError if MASSLESS in str(error) else ObjectError
        raise kind(f"MuJoCo cannot compile '{path}': {error}{advice(str(error))}") from error


def _compiled(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """Its model; advice of the compiler on simulating it (flexible bodies, attached options) is not ours to give."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return spec.compile()


def compile_object(source: ObjectSource, change: Callable[[mujoco.MjSpec], None] = _as_it_is) -> CompiledObject:
    """The object of a file; without mass, it is weighed at a uniform density if its mass is given.

    Args:
        source: How it is read.
        change: Applied to the parsed file before it is compiled.

    Raises:
        ObjectError: If the file cannot be compiled, or holds no such rigid object.
    """
    compiled = choose_object(*compile_source(source, change), source)
    if source.given.mass is None or compiled.model.body_mass[list(compiled.poses)].any():
        return compiled
    return choose_object(*compile_mjcf(source.file, _weighed(change)), source)


def compile_source(
    source: ObjectSource, change: Callable[[mujoco.MjSpec], None] = _as_it_is
) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """`compile_mjcf` of a file in which something without mass may move, if the object's mass is given.

    Raises:
        ObjectError: If the file cannot be compiled.
    """
    try:
        return compile_mjcf(source.file, change)
    except MasslessError:
        if source.given.mass is None:
            raise
        return compile_mjcf(source.file, _weighed(change))


def _weighed(change: Callable[[mujoco.MjSpec], None]) -> Callable[[mujoco.MjSpec], None]:
    def weigh_and_change(spec: mujoco.MjSpec) -> None:
        weigh_massless_bodies(spec)
        change(spec)

    return weigh_and_change


def choose_object(model: mujoco.MjModel, complaints: tuple[str, ...], source: ObjectSource) -> CompiledObject:
    """The object of a model: the body asked for, or the only one it can be, with all that is tied to it.

    Raises:
        ObjectError: If the body cannot be chosen, is articulated, flexible, or does not collide.
    """
    tree = body_tree(model)
    if model.nflex and not tree.colliding_geoms.any():
        raise ObjectError("the file holds flexible bodies only (flex); a rigid object is needed")
    root = tree.choose(source.body)
    bodies = tree.rigid(root, source.locked_joints)
    if np.isin(model.flex_vertbodyid, bodies).any():
        raise ObjectError(f"body '{tree.names[root]}' is flexible (it has a flex); a rigid object is needed")
    colliding = np.flatnonzero(collides(model) & np.isin(model.geom_bodyid, bodies))
    touchable = np.isin(model.geom_bodyid[colliding], tree.below(root))
    if not touchable.any():
        raise ObjectError(
            f"no geom of body '{tree.names[root]}', or of what is fixed below it, collides, so that fingers could "
            f"touch it; leave --body out, or name another of {', '.join(repr(tree.names[body]) for body in bodies)}"
        )
    configuration = configuration_at(model, source.keyframe)
    return CompiledObject(
        model=model,
        complaints=complaints,
        body=tree.names[root],
        poses=body_poses(model, root, bodies, configuration),
        pose_in_file=poses_in_world(model, [root], configuration)[root],
        configuration=configuration,
        colliding=tuple(int(geom) for geom in colliding),
        untouchable=frozenset(int(place) for place in np.flatnonzero(~touchable)),
    )
