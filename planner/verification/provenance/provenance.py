"""All claims of a grasp about its object, checked by reading the object and making again what was made from it."""

from pathlib import Path

from planner.errors import GraspFileError, ObjectError
from planner.files.source_file import is_there
from planner.grasps.grasp import Grasp
from planner.grasps.grasped_object import read_grasped_object
from planner.objects.graspable import Graspable
from planner.verification.check import Check, checked, not_checked
from planner.verification.provenance.choice import check_choice
from planner.verification.provenance.mass import check_mass
from planner.verification.provenance.surface import check_friction, check_geoms, check_surface
from planner.verification.provenance.task import check_task

OBJECT = "the object is the one that was planned on"


def check_provenance(grasp: Grasp, moved: Path | None = None) -> tuple[Check, ...]:
    """Read the object of a grasp, and check what the grasp says about it.

    Args:
        grasp: What to check.
        moved: Where the object's file is now; by default where the grasp says.

    Returns:
        One check per claim; where the object is absent or another, the others are not checked.
    """
    rigid_object, first = None, not_checked(OBJECT, f"{moved or grasp.file} is not there; name it with --object")
    if is_there(moved or grasp.file):
        try:
            rigid_object = read_grasped_object(grasp, moved)
            first = checked(OBJECT, True, f"body '{grasp.body}' of {rigid_object.file}, sha256 {grasp.sha256[:12]}…")
        except (GraspFileError, ObjectError) as error:
            first = checked(OBJECT, False, str(error))
    return first, *check_against(grasp, rigid_object)


def check_against(grasp: Grasp, rigid_object: Graspable | None) -> tuple[Check, ...]:
    """Check what a grasp says about an object; nothing can be where there is none."""
    located = (check_geoms(grasp, rigid_object),) if grasp.found else ()
    return (
        check_mass(grasp, rigid_object),
        check_task(grasp, rigid_object),
        check_surface(grasp, rigid_object),
        check_friction(grasp, rigid_object),
        *located,
        check_choice(grasp, rigid_object),
    )


def require_provenance(grasp: Grasp, rigid_object: Graspable) -> tuple[Check, ...]:
    """Refuse a grasp that does not belong to its object.

    Returns:
        The claims about the object: none is false, some may not have been checked.

    Raises:
        GraspFileError: If a claim about the object is false; the message has the first.
    """
    checks = check_against(grasp, rigid_object)
    for check in checks:
        if check.fails:
            raise GraspFileError(
                f"the grasp does not belong to {rigid_object.file}: it is false that {check.claim} ({check.detail}); "
                "nothing was simulated, grasp-verify checks the other claims"
            )
    return checks
