"""What `grasp-plan --json` prints: the outcome as a script wants it, in the words of the grasp file."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner.grasps.document import GraspDocument
from planner.grasps.grasp import Grasp


def plan_summary(best: Grasp, files: Sequence[Path], documents: Sequence[GraspDocument]) -> dict[str, Any]:
    """The outcome of a plan.

    Args:
        best: The best grasp.
        files: The grasp files that were written, that of the best first.
        documents: What they say.

    Returns:
        Status, rho [N], lower bound [N], gap, grip [N] (largest normal force of a finger), how much of the proof was
        checked (share, seconds), contacts (body frame, SI), the files, and how long the search took [s]; null for
        what does not exist.
    """
    document, *others = documents
    return {
        "status": document.status,
        "rho": document.rho,
        "lower_bound": document.lower_bound,
        "gap": document.gap,
        "grip": best.grip if best.found else None,
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
