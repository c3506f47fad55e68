"""What `grasp-validate` says."""

from typing import Any

import numpy as np

from planner.arrays import Mask
from sim.scene.units import WHAT_R0_IS
from sim.trial.measurement import Measurement
from sim.validation.beyond import Loads
from sim.validation.critical_force import CriticalForce
from sim.validation.force_agreement import ForceAgreement
from sim.validation.validation import Validation

TABLE_ROWS = 3
"""Wrenches shown at either end of the table of measured caps, and of those on the friction limit."""


def validation_lines(validation: Validation) -> list[str]:
    """The verdict and its evidence, line by line."""
    lines = []
    protocol = validation.protocol
    if validation.vertices is not None:
        lines.append(f"R0          {WHAT_R0_IS}; slips are relative to it")
    if validation.vertices is not None and validation.forces is not None:
        lines.append(_held(validation.vertices, protocol.hold_factor, protocol.slip_tolerance))
        lines += _spun(validation.vertices, protocol.spin_tolerance)
        lines += _forces(validation.forces, twisting=bool(validation.grasp.contacts.torsions.any()))
        lines += _limited(validation.limited, validation.vertices.held, protocol.friction_margin)
    lines += [f"control     {control.change}: {control.outcome()}" for control in validation.controls]
    if validation.critical_force is not None:
        lines += _measured(validation.critical_force)
    lines += [_beyond(loads) for loads in validation.beyond]
    lines.append(f"verdict     {validation.verdict.upper()} ({protocol.name})")
    return lines + [f"because     {reason}" for reason in validation.reasons]


def validation_summary(validation: Validation) -> dict[str, Any]:
    """The same in a few numbers, for scripts; null where nothing was measured. Forces in [N]."""
    vertices, critical = validation.vertices, validation.critical_force
    lower, upper = critical.rho if critical else (None, None)
    return {
        "verdict": validation.verdict,
        "reasons": validation.reasons,
        "rho": validation.grasp.rho,
        "critical_wrench": validation.grasp.critical_wrench,
        "wrenches": len(validation.grasp.phi),
        "held": int(vertices.held.sum()) if vertices else None,
        "friction_limited": np.flatnonzero(validation.limited).tolist(),
        "largest_slip": float(vertices.slip.max()) if vertices else None,
        "largest_spin": float(vertices.spin.max()) if vertices else None,
        "controls_behaved": all(control.behaved for control in validation.controls),
        "measured_lower": lower,
        "measured_upper": upper,
        "measured_over_predicted": critical.ratio if critical else None,
    }


def _held(vertices: Measurement, factor: float, tolerance: float) -> str:
    worst = int(np.argmax(vertices.slip))
    return (
        f"hold        cap {factor:g} rho = {vertices.caps[0]:.5g} N: {vertices.held.sum()} of {len(vertices.held)} "
        f"wrenches held; largest slip {vertices.slip[worst]:.2g} R0 (wrench {worst}; a hold is under {tolerance:g})"
    )


def _spun(vertices: Measurement, tolerance: float) -> list[str]:
    worst = int(np.argmax(vertices.spin))
    if not vertices.spin[worst]:
        return []
    return [f"spin        at most {vertices.spin[worst]:.2g} rad (wrench {worst}; a hold is under {tolerance:g})"]


def _forces(forces: ForceAgreement, *, twisting: bool) -> tuple[str, str]:
    shared = " (how fingers share a torque is theirs to settle)" if twisting else ""
    return (
        f"forces      measured differ from predicted by at most {forces.largest:.2%} of the cap (wrench "
        f"{forces.wrench}, finger {forces.finger + 1}), typically {forces.typical:.3%}",
        f"friction    utilisation differs by at most {forces.largest_utilisation:.2%} of the coefficient, typically "
        f"{forces.typical_utilisation:.3%}{shared}; the highest is {forces.highest_utilisation:.1%}",
    )


def _limited(limited: Mask, held: Mask, margin: float) -> list[str]:
    rows = np.flatnonzero(limited)
    if not rows.size:
        return []
    shown = ", ".join(str(row) for row in rows[:TABLE_ROWS])
    more = f" and {rows.size - TABLE_ROWS} more" if rows.size > TABLE_ROWS else ""
    return [
        f"limit       {rows.size} of {len(limited)} wrenches lie on the friction limit ({shown}{more}): whatever the "
        f"force, they need more than {margin:.0%} of the planned friction; {held[rows].sum()} of them held"
    ]


def _measured(critical: CriticalForce) -> list[str]:
    lower, upper = critical.rho
    order = np.argsort(critical.ratios, kind="stable")
    shown = order if len(order) <= 2 * TABLE_ROWS else np.concatenate([order[:TABLE_ROWS], order[-TABLE_ROWS:]])
    return [
        f"measured    rho is between {lower:.5g} and {upper:.5g} N; predicted {critical.phi.max():.5g} N; "
        f"ratio {critical.ratio:.4f} (critical wrench {critical.critical_wrench})",
        f"            wrenches: ratios from {critical.ratios.min():.4f} to {critical.ratios.max():.4f}",
        f"            {'wrench':>7} {'predicted':>11} {'slipped at':>11} {'held at':>11} {'ratio':>7}",
        *(
            f"            {wrench:7d} {critical.phi[wrench]:11.5g} {critical.lower[wrench]:11.5g} "
            f"{critical.upper[wrench]:11.5g} {critical.ratios[wrench]:7.4f}"
            for wrench in shown
        ),
    ]


def _beyond(loads: Loads) -> str:
    return (
        f"beyond      {loads.kind}: {loads.held} of {loads.loads} held, {'all' if loads.must_hold else 'none'} must; "
        f"largest slip {max(loads.slips):.2g} R0"
    )
