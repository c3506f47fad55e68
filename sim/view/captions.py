"""What the page says beside the scene, as Markdown. Names come from files: they are shown elsewhere, as plain text."""

from dataclasses import replace

import numpy as np

from planner.arrays import Floats
from planner.contact_models.models import model_of
from planner.grasps.grasp import Grasp
from sim.render.drawn_motion import DrawnPose
from sim.render.friction_words import friction_words
from sim.report.report_data import plain_status
from sim.view.playback import Playback
from sim.view.subject import Subject


def about(grasp: Grasp) -> str:
    """The grasp in two lines."""
    gap = f"{grasp.gap:.2%}" if np.isfinite(grasp.gap) else "open"
    return (
        f"{len(grasp.contacts)} fingers · {friction_words(grasp.contacts)} · {len(grasp.phi)} wrenches\n\n"
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
    """Every finger's planned force, the torque of soft ones, and how much of its friction they take."""
    return _table(subject, [f"planned {_what(subject)} · share of friction"], [subject.planned(wrench)])


def measured_forces(playback: Playback, poses: list[DrawnPose]) -> str:
    """The same as MuJoCo measures it in every simulation."""
    recording = playback.recording
    table = _table(playback.subject, [f"cap {cap:.4g} N" for cap in recording.measurement.caps], poses)
    return f"{table}\n\nmeasured {_what(playback.subject)} · share of the finger's friction that is taken"


def caption(playback: Playback, step: int, simulation: int) -> str:
    """Cap, slip and, as soon as it is known, the outcome of a simulation."""
    recording = playback.recording
    cap, measured = float(recording.measurement.caps[simulation]), playback.measured[simulation]
    need = "rho" if recording.wrench == playback.subject.grasp.critical_wrench else "phi"
    known = playback.outcome(step, simulation)
    slip = recording.slip_words(measured, step)
    return f"cap {cap / recording.need:g} {need} · {slip}" + (f" · {known.upper()}" if known else "")


def plain(text: str) -> str:
    """Any text as Markdown that shows just that: whatever could be markup is written as a number."""
    return "".join(letter if letter.isalnum() or letter == " " else f"&#{ord(letter)};" for letter in text)


def _what(subject: Subject) -> str:
    return "force · torque" if subject.contacts.torsions.any() else "force"


def _table(subject: Subject, names: list[str], poses: list[DrawnPose]) -> str:
    rows = [["finger", *names], ["---"] * (len(names) + 1)]
    columns = [_cells(subject, pose) for pose in poses]
    rows += [[str(finger), *cells] for finger, cells in enumerate(zip(*columns, strict=True), start=1)]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _cells(subject: Subject, pose: DrawnPose) -> list[str]:
    """Of every finger: its force, its torque where there are soft ones, and the share of its friction."""
    contacts, units = replace(subject.contacts, normals=pose.normals), subject.units
    norms = [f"{norm:.3g} N" for norm in (np.linalg.norm(pose.forces, axis=1) / units.force).tolist()]
    torques = [f" · {1e3 * torque:.3g} N mm" for torque in (pose.torques / (units.force * units.length)).tolist()]
    if not contacts.torsions.any():
        torques = [""] * len(contacts)
    shares = model_of(contacts).utilisation(pose.forces, pose.torques, contacts) / contacts.friction
    return [f"{force}{torque} · {_percent(share)}" for force, torque, share in zip(norms, torques, shares, strict=True)]


def _percent(share: float) -> str:
    return f"{share:.0%}" if np.isfinite(share) else "–"


def _triple(vector: Floats) -> str:
    return ", ".join(f"{value + 0.0:.3g}" for value in vector)
