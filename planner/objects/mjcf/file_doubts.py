"""What a file says that is not planned with as it says it."""

from collections.abc import Iterator, Sequence

import numpy as np

from planner.objects.mjcf.compiled import CompiledObject
from planner.objects.mjcf.filled_hollows import filled_hollows
from planner.objects.mjcf.names import name_at
from planner.objects.rigid_object import ConvexPart

TORSIONAL = 4
"""Contacts of this dimension and more have torsional friction."""


def file_doubts(compiled: CompiledObject, parts: Sequence[ConvexPart]) -> Iterator[str]:
    """One sentence for each thing that deserves a warning.

    Args:
        compiled: The compiled object.
        parts: One for each of its colliding geoms, in that order.
    """
    yield from _lost_faces(compiled)
    for part, share in filled_hollows(compiled, parts).items():
        yield (
            f"geom '{parts[part].geom}' collides as its convex hull, {100 * share:.0f} % of which is outside its mesh; "
            "decompose it into convex parts (--decompose) if fingers should reach into its hollows"
        )
    yield from _torsional_friction(compiled)


def _lost_faces(compiled: CompiledObject) -> Iterator[str]:
    """Meshes of which MuJoCo reads one group of several."""
    model = compiled.model
    for mesh, file in compiled.partly_read.items():
        groups = ", ".join(f"'{name}' of {count} faces" for name, count in file.groups)
        yield (
            f"the OBJ of mesh '{name_at(model, model.name_meshadr, mesh, 'mesh')}' holds {len(file.groups)} objects: "
            f"{groups}; MuJoCo reads the faces of the first only, for mass and looks, and hulls the corners of all; "
            "join them into one object, give each a file of its own, or cut parts from all faces with --decompose"
        )


def _torsional_friction(compiled: CompiledObject) -> Iterator[str]:
    """Geoms that resist turning about the normal; a hard finger does not."""
    model = compiled.model
    geoms = [geom for geom in compiled.colliding if model.geom_condim[geom] >= TORSIONAL]
    if geoms:
        torsional = model.geom_friction[geoms, 1]
        spread = " to ".join(f"{value:g}" for value in np.unique([torsional.min(), torsional.max()]))
        yield (
            f"the file gives {len(geoms)} of {len(compiled.colliding)} colliding geoms torsional friction (condim "
            f"{int(model.geom_condim[geoms].max())}, {spread} m; '{compiled.geom_name(geoms[0])}' is the first); it is "
            "not modelled yet: fingers here are hard points that turn freely about their normals"
        )
