"""An object whose hollows MuJoCo fills, as an MJCF file of its own in which they are open.

Every mesh geom whose convex hull is much larger than its mesh is cut into convex parts; everything else stays.
Source of the cutting: Wei et al., Approximate Convex Decomposition for 3D Meshes with Collision-Aware Concavity and
Tree Search (2022), the package `coacd`, an extra (`pip install rhograsp[decompose]`).
"""

import hashlib
import logging
from collections.abc import Container
from dataclasses import replace
from pathlib import Path

import numpy as np

from planner.arrays import Floats, Indices
from planner.errors import ObjectError
from planner.objects.mjcf.compiled import CompiledObject, compile_object
from planner.objects.mjcf.filled_hollows import filled_hollows
from planner.objects.mjcf.reader import as_compiled
from planner.objects.mjcf.visual import seen_triangles
from planner.objects.mjcf.writer import write_mjcf
from planner.objects.object_source import ObjectSource
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.rigid_object import ConvexPart, RigidObject

logger = logging.getLogger(__name__)

SETTINGS = {
    "threshold": 0.05,  # concavity allowed, relative to the mesh
    "mcts_iterations": 60,
    "mcts_max_depth": 2,
    "resolution": 1000,
    "decimate": True,
    "max_ch_vertex": 64,  # MuJoCo is fast with small hulls
    "seed": 0,
}
"""Of the cutting: coarser than the package's own, which takes minutes for a bowl."""


def decompose(source: ObjectSource, folder: Path) -> tuple[ObjectSource, int]:
    """Write the decomposed object, unless it is there already from the same files and settings.

    Args:
        source: How the object is read; its file is not changed.
        folder: Where to write NAME.<digest>.convex.xml.

    Returns:
        What to plan on (`source` itself if no hollow is filled) and the number of its convex parts. A mesh of which
        MuJoCo reads one group of several is cut from the faces of all.

    Raises:
        ObjectError: If the object cannot be read, `coacd` is not installed, or it finds no convex part.
        OutputError: If the folder cannot be written.
    """
    compiled = compile_object(source)
    rigid_object = as_compiled(source, compiled)
    hollows = {*filled_hollows(compiled, rigid_object.parts), *compiled.parts_of_several_groups}
    if not hollows:
        return source, len(rigid_object.parts)
    out = folder / f"{source.file.stem}.{_key(rigid_object)}.convex.xml"
    if not out.is_file():
        write_mjcf(out, _cut(rigid_object, compiled, hollows), seen_triangles(compiled))
    opened = ObjectSource(file=out, body=rigid_object.body, given=source.given)
    return opened, len(compile_object(opened).colliding)


def _cut(rigid_object: RigidObject, compiled: CompiledObject, hollows: Container[int]) -> RigidObject:
    """The object with these of its parts in pieces."""
    parts: list[ConvexPart] = []
    torsion: list[float] = []
    untouchable: set[int] = set()
    for number, part in enumerate(rigid_object.parts):
        mesh = compiled.mesh(compiled.colliding[number]) if number in hollows else None
        pieces = [part] if mesh is None else convex_parts(*mesh, geom=part.geom, friction=part.friction)
        if number in rigid_object.untouchable:
            untouchable |= set(range(len(parts), len(parts) + len(pieces)))
        parts += pieces
        torsion += [float(rigid_object.torsions[number])] * len(pieces)
    return replace(rigid_object, parts=tuple(parts), torsion=tuple(torsion), untouchable=frozenset(untouchable))


def convex_parts(vertices: Floats, faces: Indices, *, geom: str, friction: float) -> list[Polyhedron]:
    """Convex parts of a mesh, named after its geom; slivers without a face to touch are left out.

    Pieces of the mesh that are convex already stay exactly as they are.

    Args:
        vertices: Shape (n, 3) [m].
        faces: Vertex numbers of its triangles, shape (faces, 3).
        geom: Name of the geom.
        friction: Of the geom.

    Raises:
        ObjectError: If `coacd` is not installed or finds no part.
    """
    convex, hollow = _pieces(vertices, faces)
    parts = []
    for number, corners in enumerate([*convex, *(_run_coacd(*hollow) if hollow else ())]):
        try:
            parts.append(Polyhedron.hull(corners, geom=f"{geom}/{number}", friction=friction))
        except ObjectError as error:
            logger.warning("a piece of geom '%s' was left out: %s", geom, error)
    if not parts:
        raise ObjectError(f"coacd finds no convex part in geom '{geom}'; decompose its mesh by hand")
    return parts


def _pieces(vertices: Floats, faces: Indices) -> tuple[list[Floats], tuple[Floats, Indices] | None]:
    """Corners of the closed convex pieces of a mesh, and the mesh of all others; one with cavities stays whole."""
    from trimesh import Trimesh  # here: half a second that only decompositions need
    from trimesh.util import concatenate

    mesh = Trimesh(vertices, faces)
    pieces = mesh.split(only_watertight=False)
    convex = [piece.is_watertight and piece.is_convex for piece in pieces]
    if any(piece.is_watertight and piece.volume < 0 for piece in pieces) or not any(convex):
        return [], (vertices, faces)
    hollow = [piece for piece, whole in zip(pieces, convex, strict=True) if not whole]
    rest = concatenate(hollow) if hollow else None
    solids = [piece.vertices for piece, whole in zip(pieces, convex, strict=True) if whole]
    return solids, None if rest is None else (rest.vertices, rest.faces)


def _run_coacd(vertices: Floats, faces: Indices) -> list[Floats]:
    """Corners of the convex pieces into which `coacd` cuts a mesh."""
    try:
        import coacd
    except ImportError as error:
        raise ObjectError("--decompose needs coacd; install it with: pip install 'rhograsp[decompose]'") from error
    coacd.set_log_level("error")
    pieces = coacd.run_coacd(coacd.Mesh(vertices, faces.astype(np.int32)), **SETTINGS)
    return [np.asarray(corners) for corners, _ in pieces]


def _key(rigid_object: RigidObject) -> str:
    """Names the object, how it is read, and the settings."""
    source, given = rigid_object.source, rigid_object.source.given
    center = None if given.center_of_mass is None else given.center_of_mass.tolist()
    read = f"{source.body} {given.mass} {center} {source.locked_joints} {source.keyframe}"
    return hashlib.sha256(f"{rigid_object.sha256} {read} {SETTINGS}".encode()).hexdigest()[:12]
