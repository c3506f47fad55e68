"""From measurements to a verdict, with the sentences that speak against rho or against the experiment."""

from collections.abc import Sequence
from enum import StrEnum

import numpy as np

from planner.arrays import Mask
from planner.millimetres import in_mm
from sim.trial.measurement import Measurement
from sim.trial.protocol import ValidationProtocol


class Verdict(StrEnum):
    """What the experiment says about rho. True in a condition only if it confirms rho."""

    PASS = "pass"
    """Every wrench was held and every control behaved."""
    FAIL = "fail"
    """Some wrench was not held, in an experiment whose controls behaved."""
    NOT_TRUSTWORTHY = "not trustworthy"
    """A control did not behave: the experiment proves nothing, whatever was held."""

    def __bool__(self) -> bool:
        return self is Verdict.PASS


def judge(objections: Sequence[str], doubts: Sequence[str]) -> Verdict:
    """The verdict that follows from what speaks against rho and what speaks against the experiment."""
    if doubts:
        return Verdict.NOT_TRUSTWORTHY
    return Verdict.FAIL if objections else Verdict.PASS


def undecided(vertices: Measurement, limited: Mask, protocol: ValidationProtocol) -> tuple[str, ...]:
    """Wrenches on the friction limit that were not held: they speak neither for rho nor against it.

    Args:
        vertices: Every wrench with the cap above rho.
        limited: Which lie on the friction limit, shape (wrenches,).
        protocol: Settings.
    """
    failed = np.flatnonzero(~vertices.held & limited)
    if not failed.size:
        return ()
    return (
        f"{failed.size} of {len(vertices.held)} wrenches lie on the friction limit and were not held (the first is "
        f"wrench {failed[0]}): whatever the force, they need more than {protocol.friction_margin:.0%} of the planned "
        "friction, so a larger cap gives no margin and MuJoCo cannot decide; plan with more friction or another task",
    )


def unheld(vertices: Measurement, limited: Mask, reach: float, protocol: ValidationProtocol) -> tuple[str, ...]:
    """Why the wrenches with the cap above rho were not all held; empty if they were, but for the limited ones.

    Args:
        vertices: Every wrench with the cap above rho.
        limited: Which lie on the friction limit, shape (wrenches,).
        reach: R0 [m].
        protocol: Settings.
    """
    failed = np.flatnonzero(~vertices.held & ~limited)
    if not failed.size:
        return ()
    worst = int(failed[vertices.gone(protocol)[failed].argmax()])
    lost = np.flatnonzero(vertices.lost[worst])
    allowed = protocol.motion_tolerance
    moved = in_mm(reach * vertices.translations[worst], 2)
    spin = float(vertices.spin[worst])
    spun = f", spun {spin:.2g} rad (allowed {protocol.spin_tolerance:g})" if spin else ""
    touch = f", fingers {(lost + 1).tolist()} lost contact" if lost.size else ""
    return (
        f"{failed.size} of {len(vertices.held)} wrenches were not held with the cap at {protocol.hold_factor:g} rho "
        f"= {vertices.caps[0]:.5g} N; wrench {worst} slipped {vertices.slip[worst]:.2g} R0 (allowed "
        f"{protocol.slip_tolerance:g}){spun} and the object moved {moved} mm and turned "
        f"{np.rad2deg(vertices.rotations[worst]):.2g} degrees (allowed {in_mm(reach * allowed, 2)} mm, "
        f"{np.rad2deg(allowed):.2g} degrees){touch}",
    )
