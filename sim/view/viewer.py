"""The live view: reads what the visitor asks for, many times a second, and draws it. All in one thread."""

import time
from collections.abc import Sequence

import numpy as np
import viser

from planner.errors import SettingError, SimulationError
from planner.objects.vectors import unit
from sim.render.view import FIELD, View
from sim.view import captions as words
from sim.view.controls import Controls
from sim.view.layout import Layout, plan_layout, trial_layout
from sim.view.playback import play_back
from sim.view.screening import Screening
from sim.view.shown_trial import ShownTrial
from sim.view.subject import Subject

RATE = 25
"""Pictures per second."""
PATIENCE = 0.2
"""Seconds between two changes of the words and the chart during playback, which cost a browser most [s]."""
AMBIENT = 1.4
"""Light from everywhere."""
LAMPS = ((1.6, (-0.4, -1.0, 1.2)), (0.8, (1.0, 0.6, 0.4)))
"""Strengths of other lights, and where they come from, in the axes of the body frame."""
SIMULATIONS = ("first", "second")
"""Names of what is drawn: the plan is where the first simulation is."""


class Viewer:
    """Shows some grasps on the pages of one server."""

    def __init__(self, server: viser.ViserServer, subjects: Sequence[Subject], *, trial: bool = False) -> None:
        """
        Args:
            server: Of the pages.
            subjects: What can be looked at, one or more.
            trial: Whether to begin with the trial, and not with the plan.
        """
        self.server, self.subjects = server, subjects
        server.gui.configure_theme(show_logo=False, show_share_button=False)
        server.gui.main_panel.dock_right()
        _light(server.scene)
        self.controls = Controls(server.gui, [subject.name for subject in subjects])
        self.controls.ask(trial=trial)
        self.trials: list[ShownTrial] = []
        self.screening: Screening | None = None
        self._entered: int | None = None
        self._tried: int | None = None
        self._problem = ""
        self._asked: tuple[object, ...] = ()
        self._step: int | None = None
        self._seen: tuple[int | None, bool] | None = None
        self._told = 0.0

    def run(self) -> None:
        """Draw until something interrupts."""
        before = time.perf_counter()
        while True:
            now = time.perf_counter()
            self.refresh(now - before)
            before = now
            time.sleep(max(0.0, 1 / RATE - (time.perf_counter() - now)))

    def refresh(self, seconds: float) -> None:
        """Let time pass [s], and draw what has changed."""
        controls = self.controls
        if controls.grasp != self._entered:
            self._enter(controls.grasp)
        if controls.wants_critical():
            controls.wrench = self.subject.grasp.critical_wrench
        wanted = controls.wrench if controls.trial else None
        if wanted != self._tried:
            self._try(wanted)
        if self.screening:
            self.screening.advance(seconds)
        asked = (self._entered, self._tried, controls.wrench, controls.enlarged)
        if asked != self._asked:
            self._asked, self._step = asked, None
            self._layout = self._arranged()
            self._look(self._layout.view)
        step = self.screening.player.step if self.screening else 0
        if step != self._step:
            with self.server.atomic():
                self._draw(self._layout)
            self._step = step

    @property
    def subject(self) -> Subject:
        """What is looked at."""
        return self.subjects[self._entered or 0]

    def _enter(self, grasp: int) -> None:
        """Look at another grasp."""
        self._try(None)
        for trial in self.trials:
            trial.remove()
        self._entered = grasp
        self.trials = [ShownTrial(self.server.scene, self.subject, name) for name in SIMULATIONS]
        self.server.gui.set_panel_label(self.subject.name)
        self.controls.take_subject(self.subject, words.about(self.subject.grasp))

    def _try(self, wrench: int | None) -> None:
        """Run the trial of a wrench, or leave the trial."""
        before = self.screening.player if self.screening else None
        if self.screening:
            self.screening.close()
        self._tried, self._problem, self.screening = wrench, "", None
        if wrench is None:
            return
        try:
            playback = play_back(self.subject, wrench)
        except (SettingError, SimulationError) as error:
            self._problem = str(error)
            return
        self.screening = Screening(self.server.gui, self.controls, playback, before)

    def _arranged(self) -> Layout:
        """Where everything belongs."""
        if self.screening:
            return trial_layout(self.screening.playback, self.screening.factor)
        return plan_layout(self.subject, self.controls.wrench)

    def _draw(self, layout: Layout) -> None:
        self.controls.asked.content = words.asked(self.subject, self.controls.wrench)
        if self.screening:
            self._draw_trial(self.screening, layout)
        else:
            self._draw_plan(layout)

    def _draw_plan(self, layout: Layout) -> None:
        subject, wrench = self.subject, self.controls.wrench
        first, *others = self.trials
        first.show(subject.planned(wrench), subject.load(wrench))
        first.place(layout.places[0], ghost=False)
        first.say("", layout.caption)
        for trial in others:
            trial.root.visible = False
        problem = f"\n\nthe trial cannot be shown: {words.plain(self._problem)}" if self._problem else ""
        self.controls.forces.content = words.planned_forces(subject, wrench) + problem

    def _draw_trial(self, screening: Screening, layout: Layout) -> None:
        playback, step = screening.playback, screening.player.step
        load = self.subject.load(playback.recording.wrench)
        poses = [playback.pose(step, simulation, screening.factor) for simulation in range(len(self.trials))]
        for simulation, (trial, pose) in enumerate(zip(self.trials, poses, strict=True)):
            trial.root.visible = True
            trial.show(pose, load, playback.share(step))
            trial.place(layout.places[simulation], ghost=not playback.recording.measurement.held[simulation])
            trial.say(words.caption(playback, step, simulation), layout.caption)
        if not screening.player.playing or time.perf_counter() - self._told > PATIENCE:
            screening.chart.show(step)
            self.controls.forces.content = words.measured_forces(playback, poses)
            self._told = time.perf_counter()

    def _look(self, view: View) -> None:
        """Move the cameras of all pages when something else is shown than before; for the same grasp each keeps the
        direction that its visitor has turned to."""
        shown = (self._entered, self.screening is None)
        if shown == self._seen:
            return
        turned = self._seen is not None and shown[0] == self._seen[0]
        self._seen, camera = shown, self.server.initial_camera
        camera.position, camera.look_at = view.target + view.distance * view.axes[2], view.target
        camera.fov = float(np.deg2rad(FIELD))
        for client in self.server.get_clients().values():
            back = unit(client.camera.position - client.camera.look_at) if turned else view.axes[2]
            with client.atomic():
                client.camera.position = view.target + view.distance * back
                client.camera.look_at = view.target


def _light(scene: viser.SceneApi) -> None:
    """Even light in which colours are what they are; viser's own is for metal and bleaches them."""
    scene.configure_environment_map(None)
    scene.configure_default_lights(enabled=False)
    scene.add_light_ambient("/light/ambient", intensity=AMBIENT)
    for number, (strength, source) in enumerate(LAMPS):
        scene.add_light_directional(f"/light/{number}", intensity=strength, position=source)
