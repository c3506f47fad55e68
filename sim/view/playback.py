"""The recorded trial of one wrench, any instant of it in the units of the view."""

from dataclasses import dataclass, replace
from functools import cached_property

from planner.arrays import Floats
from sim.render.drawn_motion import DrawnPose, drawn_pose, motion_factor
from sim.render.recording import Recording, known_outcome, record
from sim.trial.measurement import Measurement
from sim.view.subject import Subject


@dataclass(frozen=True, eq=False, kw_only=True)
class Playback:
    """What MuJoCo did with the cap just above and just below what the wrench needs."""

    subject: Subject
    recording: Recording

    @property
    def last(self) -> int:
        """The last step."""
        return self.recording.steps - 1

    @cached_property
    def factor(self) -> int:
        """By how much motion must be enlarged to be seen."""
        return motion_factor(self.recording, self.subject.rigid_object)

    @cached_property
    def measured(self) -> tuple[Measurement, ...]:
        """Every simulation judged after every step."""
        return tuple(self.recording.measured(simulation) for simulation in range(len(self.recording.trial.caps)))

    @property
    def gone(self) -> list[Floats]:
        """How far the fingertips are gone, see `Measurement.gone`, of every simulation, each of shape (steps,)."""
        return [measured.gone(self.recording.experiment.protocol) for measured in self.measured]

    def pose(self, step: int, simulation: int, factor: float = 1.0) -> DrawnPose:
        """Where everything is at a step, its motion so many times larger, and the measured forces."""
        pose = drawn_pose(self.recording, step, simulation, factor)
        scale = self.subject.units.length / self.recording.experiment.units.length
        lengths = ("position", "tips", "contacts", "torques")
        return replace(pose, **{name: scale * getattr(pose, name) for name in lengths})

    def share(self, step: int) -> float:
        """Part of the wrench that acts during a step."""
        return float(self.recording.loads[step])

    def outcome(self, step: int, simulation: int) -> str:
        """How a simulation has ended by a step, in a word; empty while that is open."""
        return known_outcome(self.measured[simulation], step, self.recording.experiment.protocol)


def play_back(subject: Subject, wrench: int) -> Playback:
    """Run the trial of a wrench and keep it.

    Raises:
        SettingError: When the wrench needs no force.
        SimulationError: When the experiment cannot be built or run as described.
    """
    return Playback(subject=subject, recording=record(subject.rigid_object, subject.grasp, wrench))
