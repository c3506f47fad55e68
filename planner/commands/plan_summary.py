"""What `grasp-plan --json` prints: the outcome as a script wants it, in the words of the grasp file."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import document_of


def plan_summary(grasps: Sequence[Grasp], files: Sequence[Path]) -> dict[str, Any]:
    """The outcome of a plan.

    Args:
        grasps: The best first.
        files: The grasp files they were written to.

    Returns:
        Status, rho [N], lower bound [N], gap, grip [N] (largest normal force of a finger), how much of the proof was
        checked (share, seconds), contacts (body frame, SI), the files, and how long the search took [s]; null for
        what does not exist.
    """
    document, *others = (document_of(grasp, file) for grasp, file in zip(grasps, files, strict=True))
    return {
        "status": document.status,
        "rho": document.rho,
        "lower_bound": document.lower_bound,
        "gap": document.gap,
        "grip": grasps[0].grip if grasps[0].found else None,
        "proof_check": document.proof_check,
        "critical_wrench": document.critical_wrench,
        "contacts": document.contacts,
        "fingers": document.search.fingers,
        "candidates": document.search.candidates,
        "subsets": document.search.subsets,
        "seconds": document.search.seconds,
        "file": str(files[0]),
        "others": [{"rho": other.rho, "file": str(file)} for other, file in zip(others, files[1:], strict=True)],
    }
