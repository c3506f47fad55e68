"""From measurements to a verdict: the sentences that speak against rho, none if it is confirmed."""

import numpy as np

from sim.measurement import Measurement
from sim.protocol import ValidationProtocol


def objections(
    vertices: Measurement, control: Measurement, critical_wrench: int, protocol: ValidationProtocol
) -> tuple[str, ...]:
    """One sentence per way in which the experiment contradicts rho.

    Args:
        vertices: Every wrench with the cap above rho.
        control: The critical wrench with the cap below rho.
        critical_wrench: Its index among the vertices.
        protocol: Thresholds, to be quoted.
    """
    return (*_unheld(vertices, protocol), *_uncontrolled(control, critical_wrench, protocol))


def _unheld(vertices: Measurement, protocol: ValidationProtocol) -> tuple[str, ...]:
    """Why the wrenches above rho were not all held."""
    failed = np.flatnonzero(~vertices.held)
    if not failed.size:
        return ()
    worst = int(failed[vertices.slip[failed].argmax()])
    return (
        f"{failed.size} of {len(vertices.held)} wrenches were not held with the cap at {protocol.hold_factor:g} rho "
        f"= {vertices.caps[0]:.5g} N; {_evidence(vertices, worst, worst, protocol)}",
    )


def _uncontrolled(control: Measurement, critical_wrench: int, protocol: ValidationProtocol) -> tuple[str, ...]:
    """Why the negative control did not do what it must."""
    if not control.held[0]:
        return ()
    return (
        f"the critical wrench was held with the cap at {protocol.control_factor:g} rho = {control.caps[0]:.5g} N, "
        f"so rho is not the least cap; {_evidence(control, 0, critical_wrench, protocol)}",
    )


def _evidence(measurement: Measurement, row: int, wrench: int, protocol: ValidationProtocol) -> str:
    lost = np.flatnonzero(measurement.lost[row])
    touch = f", fingers {lost.tolist()} lost contact" if lost.size else ""
    return (
        f"wrench {wrench} slipped {measurement.slip[row]:.2g} R0 (allowed {protocol.slip_tolerance:g}) and the object "
        f"moved {measurement.translations[row]:.2g} R0, {measurement.rotations[row]:.2g} rad "
        f"(allowed {protocol.motion_tolerance:g}){touch}"
    )
