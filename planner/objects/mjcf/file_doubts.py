"""What a file says that is not planned with as it says it."""

from collections.abc import Iterator, Sequence

from planner.objects.mjcf.compiled import CompiledObject
from planner.objects.mjcf.filled_hollows import filled_hollows
from planner.objects.mjcf.names import name_at
from planner.objects.rigid_object import ConvexPart


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
