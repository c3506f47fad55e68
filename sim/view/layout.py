"""Where things stand and where the camera is: the plan alone, or the two simulations of its trial side by side."""

from dataclasses import dataclass

import numpy as np

from planner.arrays import Floats
from sim.render.extent import extent
from sim.render.view import View
from sim.view.playback import Playback
from sim.view.subject import Subject

GAP = 1.06
"""Distance between the two simulations, relative to the width of one."""
BELOW = 0.06
"""Of a caption, below everything else."""
ASPECT = 1.3
"""Width over height of a scene into which everything must fit; most windows are wider."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Layout:
    """Places in the scene, in the units of the view."""

    places: tuple[Floats, ...]
    """Of what is shown, each of shape (3,)."""

    caption: Floats
    """Of a caption relative to what it is about, shape (3,)."""

    view: View


def plan_layout(subject: Subject, wrench: int) -> Layout:
    """The plan alone, in the middle."""
    points = _planned_extent(subject, wrench)
    return _layout(subject, points, (np.zeros(3),))


def trial_layout(playback: Playback, factor: float) -> Layout:
    """Both simulations, as they end, side by side as the camera sees them."""
    subject, load = playback.subject, playback.subject.load(playback.recording.wrench)
    corners, contacts = subject.triangles.reshape(-1, 3), subject.contacts
    simulations = range(len(playback.recording.trial.caps))
    poses = [playback.pose(playback.last, simulation, factor) for simulation in simulations]
    ends = [extent(corners, contacts, pose, load) for pose in poses]
    points = np.concatenate([_planned_extent(subject, playback.recording.wrench), *ends])
    right = subject.direction.axes[0]
    shift = GAP * float(np.ptp(points @ right)) * right
    return _layout(subject, points, tuple((number - (len(poses) - 1) / 2) * shift for number in simulations))


def _planned_extent(subject: Subject, wrench: int) -> Floats:
    corners = subject.triangles.reshape(-1, 3)
    return extent(corners, subject.contacts, subject.planned(wrench), subject.load(wrench))


def _layout(subject: Subject, points: Floats, places: tuple[Floats, ...]) -> Layout:
    """So that points, shape (n, 3), are seen at every place, with a caption below."""
    right, up, _ = subject.direction.axes
    across, height = points @ right, points @ up
    caption = (across.max() + across.min()) / 2 * right + (height.min() - BELOW) * up
    everything = np.concatenate([np.vstack([points, caption - BELOW * up]) + place for place in places])
    return Layout(places=places, caption=caption, view=subject.direction.fitted(everything, ASPECT))
