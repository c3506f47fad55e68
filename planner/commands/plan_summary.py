"""What `grasp-plan --json` prints: the outcome as a script wants it, taken from the grasp file just written."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from planner.grasps.document import GraspDocument


def plan_summary(files: Sequence[Path]) -> dict[str, Any]:
    """The outcome of a plan.

    Args:
        files: The grasp files, the best grasp first.

    Returns:
        Status, rho [N], lower bound [N], gap, how much of the proof was checked (share, seconds), contacts (body
        frame, SI), the files, and how long the search took [s]; null for what does not exist.
    """
    document, *others = (msgspec.json.decode(file.read_bytes(), type=GraspDocument) for file in files)
    return {
        "status": document.status,
        "rho": document.rho,
        "lower_bound": document.lower_bound,
        "gap": document.gap,
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
