"""The object a grasp file was planned on, read again and known to be unchanged."""

from dataclasses import replace
from pathlib import Path

from planner.errors import GraspFileError
from planner.files.source_file import is_there
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable
from planner.objects.object_file import read_object_file


def read_grasped_object(grasp: Grasp, moved: Path | None = None) -> Graspable:
    """Read the object of a grasp.

    Args:
        grasp: The grasp.
        moved: Where the object's file is now; by default where the grasp says.

    Raises:
        ObjectError: When the file cannot be read.
        GraspFileError: When it is not the object the grasp was planned on.
    """
    source = grasp.source if moved is None else replace(grasp.source, file=moved)
    file = source.file
    if not is_there(file):
        raise GraspFileError(f"the object {file} is not there; say where it is now with --object")
    rigid_object = read_object_file(source)
    if rigid_object.sha256 != grasp.sha256:
        raise GraspFileError(
            f"{file}, or a file it includes, has changed since the grasp was planned (sha256 "
            f"{rigid_object.sha256[:12]}… instead of {grasp.sha256[:12]}…); plan it again, or name the original "
            "with --object"
        )
    if rigid_object.extent.size != grasp.certificate.candidates.dimension:
        raise GraspFileError(
            f"{file} holds an object of {rigid_object.extent.size} dimensions, the grasp has contacts of "
            f"{grasp.certificate.candidates.dimension}; name the object it was planned on with --object"
        )
    return rigid_object
