"""What `grasp-validate` says."""

import numpy as np

from sim.measurement import Measurement
from sim.validate import Validation


def summary(validation: Validation) -> list[str]:
    """The verdict and its evidence, line by line."""
    lines = []
    protocol = validation.protocol
    if validation.vertices is not None:
        lines += _held(validation.vertices, protocol.hold_factor, protocol.slip_tolerance)
        lines.append(_forces(validation.vertices))
    if validation.control is not None:
        held = "held" if validation.control.held[0] else "slipped"
        lines.append(
            f"control     cap {protocol.control_factor:g} rho = {validation.control.caps[0]:.5g} N: "
            f"critical wrench {validation.critical_wrench} {held}, slip {validation.control.slip[0]:.2g} R0"
        )
    lines.append(f"verdict     {'PASS' if validation.verdict else 'FAIL'} ({protocol.name})")
    return lines + [f"because     {reason}" for reason in validation.reasons]


def _held(vertices: Measurement, factor: float, tolerance: float) -> list[str]:
    worst = int(np.argmax(vertices.slip))
    return [
        f"hold        cap {factor:g} rho = {vertices.caps[0]:.5g} N: {vertices.held.sum()} of {len(vertices.held)} "
        f"wrenches held; largest slip {vertices.slip[worst]:.2g} R0 (wrench {worst}; a hold is under {tolerance:g})"
    ]


def _forces(vertices: Measurement) -> str:
    difference = np.abs(vertices.measured_forces - vertices.predicted_forces) / vertices.caps[:, None]
    return (
        f"forces      measured differ from predicted by at most {difference.max():.2%} of the cap, "
        f"typically {np.median(difference):.2%}"
    )
