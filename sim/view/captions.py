"""What the page says beside the scene, as Markdown. Names come from files: they are shown elsewhere, as plain text."""

import numpy as np

from planner.arrays import Floats
from planner.contact_models.friction_cone import utilisation
from planner.grasps.grasp import Grasp
from sim.render.drawn_motion import DrawnPose
from sim.report.report_data import plain_status
from sim.view.playback import Playback
from sim.view.subject import Subject


def about(grasp: Grasp) -> str:
    """The grasp in two lines."""
    friction = sorted({float(mu) for mu in grasp.contacts.friction})
    friction_words = " to ".join(f"{mu:g}" for mu in dict.fromkeys((friction[0], friction[-1])))
    gap = f"{grasp.gap:.2%}" if np.isfinite(grasp.gap) else "open"
    return (
        f"{len(grasp.contacts)} fingers · friction {friction_words} · {len(grasp.phi)} wrenches\n\n"
        f"**rho = {grasp.rho:.4g} N** ({plain_status(grasp)}, gap {gap})"
    )


def asked(subject: Subject, wrench: int) -> str:
    """The wrench and what it needs."""
    grasp = subject.grasp
    force, moment = np.split(grasp.task.wrenches[wrench], 2)
    critical = ", which is rho: the critical wrench" if wrench == grasp.critical_wrench else ""
    return (
        f"force ({_triple(force)}) N · moment ({_triple(moment)}) N m\n\nneeds **{grasp.phi[wrench]:.4g} N**{critical}"
    )


def planned_forces(subject: Subject, wrench: int) -> str:
    """Every finger's planned force and how much of its friction that takes."""
    return _table(subject, ["planned force · share of friction"], [subject.planned(wrench)])


def measured_forces(playback: Playback, poses: list[DrawnPose]) -> str:
    """The same as MuJoCo measures it in every simulation."""
    recording = playback.recording
    table = _table(playback.subject, [f"cap {cap:.4g} N" for cap in recording.measurement.caps], poses)
    return f"{table}\n\nmeasured force · share of the finger's friction that it takes"


def caption(playback: Playback, step: int, simulation: int) -> str:
    """Cap, slip and, as soon as it is known, the outcome of a simulation."""
    recording = playback.recording
    cap, slip = float(recording.measurement.caps[simulation]), float(playback.slips[simulation][step])
    need = "rho" if recording.wrench == playback.subject.grasp.critical_wrench else "phi"
    known = playback.outcome(step, simulation)
    return f"cap {cap / recording.need:g} {need} · slip {slip:.1g} R0" + (f" · {known.upper()}" if known else "")


def plain(text: str) -> str:
    """Any text as Markdown that shows just that: whatever could be markup is written as a number."""
    return "".join(letter if letter.isalnum() or letter == " " else f"&#{ord(letter)};" for letter in text)


def _table(subject: Subject, names: list[str], poses: list[DrawnPose]) -> str:
    rows = [["finger", *names], ["---"] * (len(names) + 1)]
    friction = subject.grasp.contacts.friction
    norms = [np.linalg.norm(pose.forces, axis=1) * subject.grasp.rho for pose in poses]
    shares = [utilisation(pose.forces, pose.normals) / friction for pose in poses]
    for finger in range(len(friction)):
        cells = [f"{norm[finger]:.3g} N · {_percent(share[finger])}" for norm, share in zip(norms, shares, strict=True)]
        rows.append([str(finger + 1), *cells])
    lines = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    return lines


def _percent(share: float) -> str:
    return f"{share:.0%}" if np.isfinite(share) else "–"


def _triple(vector: Floats) -> str:
    return ", ".join(f"{value + 0.0:.3g}" for value in vector)
