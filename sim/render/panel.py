"""One simulation at one instant, drawn: object, fingertips, friction cones, measured forces and the load."""

from dataclasses import dataclass

import mujoco
import numpy as np

from planner.arrays import Floats, Pixels
from planner.objects.rigid_object import RigidObject
from sim.render.annotations import Annotations
from sim.render.canvas import Canvas
from sim.render.drawn_motion import DrawnPose, drawn_pose, motion_factor
from sim.render.drawn_scene import SHADOW_PIXELS, drawn_scene
from sim.render.extent import extent
from sim.render.load import placed_load
from sim.render.outline import visible_edges
from sim.render.palette import BACKGROUND, CONE, EDGE, FORCE, GHOST, TIP, rgb
from sim.render.proportions import (
    ARC_ROD,
    ARROW,
    BEYOND,
    CONE_HEIGHT,
    CONE_OPACITY,
    LABEL_DEPTH,
    LEAST_FORCE,
    SHAFT,
    TWIST,
    twists,
)
from sim.render.recording import Recording
from sim.render.shadow import fallen, soft_shadow
from sim.render.sight import open_to
from sim.render.view import View, best_direction

LIFT = 0.002
"""How far edges are drawn in front of the surface, relative to the object's size."""
EDGE_WIDTH = 1 / 360
"""Of the picture's height."""
GLOW = 0.35
"""How much of a hidden arrow is seen through the object and the cones."""
GEOMS_PER_FINGER, GEOMS_PER_LOAD = 60, 60
"""Shapes that are drawn for a finger and for the load, at most."""
ABOVE = 0.02
"""How far outside the contact one looks for what hides it, relative to the object's size."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Label:
    """Where the number of a contact stands [pixels]."""

    column: float
    row: float

    hidden: bool
    """Whether the object is in front of the contact."""


class Panel:
    """Draws the simulations of one recording, all from the same place; to be closed."""

    def __init__(
        self,
        rigid_object: RigidObject,
        recording: Recording,
        width: int,
        height: int,
        direction: tuple[float, float] | None = None,
    ) -> None:
        """
        Args:
            rigid_object: What is held, in the body frame, SI.
            recording: What happened.
            width: Of the picture [pixels].
            height: Of the picture [pixels].
            direction: Azimuth and elevation of the camera [degrees]; by default where the contacts are seen best.

        Raises:
            RenderingError: When there is no OpenGL to draw with.
        """
        self.width, self.height, self._recording = width, height, recording
        units, contacts = recording.experiment.units, recording.experiment.scene.contacts
        self._triangles = np.concatenate([units.points(part.triangles()[0]) for part in rigid_object.parts])
        self._edges = units.points(visible_edges(rigid_object))
        self._size = rigid_object.size * units.length
        self.factor = motion_factor(recording, rigid_object)
        azimuth, elevation = direction or best_direction(self._triangles, contacts)
        towards = View(azimuth=azimuth, elevation=elevation, target=np.zeros(3), distance=1.0)
        self._load = placed_load(recording.trial.wrenches[0], self._triangles, towards.axes[2], self._size)
        shown = self._extent()
        floor = float(shown[:, 2].min())
        corners = self._triangles.reshape(-1, 3)
        shadow = np.column_stack([fallen(corners, floor), np.full(len(corners), floor)])
        self.view = towards.fitted(np.concatenate([shown, shadow]), width / height)
        self._drawn = drawn_scene(rigid_object, recording.experiment, self.view, floor, width, height)
        self._data = mujoco.MjData(self._drawn.model)
        geoms = GEOMS_PER_LOAD + GEOMS_PER_FINGER * len(contacts) + 2 * len(self._edges) + self._drawn.model.ngeom
        self._scene = mujoco.MjvScene(self._drawn.model, geoms)
        self._canvas = Canvas(self._drawn.model, width, height)

    @property
    def has_edges(self) -> bool:
        """Whether the object is drawn with edges, and so with those of its planned place."""
        return len(self._edges) > 0

    def close(self) -> None:
        """Free the graphics card."""
        self._canvas.close()

    def draw(self, step: int, simulation: int) -> tuple[Pixels, list[Label]]:
        """The picture, shape (height, width, 3), and where the contacts' numbers stand."""
        pose = drawn_pose(self._recording, step, simulation, self.factor)
        share = float(self._recording.loads[step])
        placed = self._triangles @ pose.rotation.T + pose.position
        self._place(pose, placed)
        annotations = Annotations(scene=self._scene, model=self._drawn.model, head=self._drawn.head)
        self._draw_edges(annotations, pose, ghost=simulation > 0)
        self._draw_cones(annotations, pose)
        self._draw_arrows(annotations, pose, share)
        pixels = self._canvas.draw(self._scene)
        self._scene.ngeom = 0
        self._draw_arrows(annotations, pose, share)
        return _shining_through(pixels, self._canvas.draw(self._scene)), self._labels(pose, placed)

    def _place(self, pose: DrawnPose, triangles: Floats) -> None:
        """Put the object, and its shadow, where they belong; everything else is taken away."""
        drawn, data = self._drawn, self._data
        data.mocap_pos[0] = pose.position
        mujoco.mju_mat2Quat(data.mocap_quat[0], pose.rotation.ravel())
        mujoco.mj_forward(drawn.model, data)
        texture = soft_shadow(triangles, drawn.floor, drawn.floor_half, SHADOW_PIXELS)
        self._canvas.upload(drawn.model, drawn.shadow, texture)
        everything = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(drawn.model, data, mujoco.MjvOption(), None, self.view.camera(), everything, self._scene)

    def _draw_edges(self, annotations: Annotations, pose: DrawnPose, ghost: bool) -> None:
        """The object's edges, and where they were planned if the object is to be lost."""
        lift = LIFT * self._size * self.view.axes[2]
        width = max(1.0, EDGE_WIDTH * self.height)
        for start, stop in self._edges @ pose.rotation.T + pose.position + lift:
            annotations.line(start, stop, width, EDGE)
        if ghost:
            for start, stop in self._edges - lift:
                annotations.line(start, stop, width, GHOST)

    def _draw_cones(self, annotations: Annotations, pose: DrawnPose) -> None:
        """Friction cones are mirrored to the outside, where the arrows are: one on the mantle is about to slide."""
        for mesh, contact, normal in zip(self._drawn.cones, pose.contacts, pose.normals, strict=True):
            annotations.cone(mesh, contact, -normal, CONE_HEIGHT * self._size, CONE, CONE_OPACITY)

    def _draw_arrows(self, annotations: Annotations, pose: DrawnPose, share: float) -> None:
        """Fingertips with their forces, which end at the contacts, their torques beyond the cones, and the load."""
        size, scene = self._size, self._recording.experiment.scene
        for tip, contact, force in zip(pose.tips, pose.contacts, pose.forces, strict=True):
            annotations.sphere(tip, scene.tip_radius, TIP)
            if np.linalg.norm(force) > LEAST_FORCE:
                annotations.arrow(contact, ARROW * size * force, SHAFT * size, FORCE)
        for contact, normal, twist in zip(
            pose.contacts, pose.normals, twists(pose.torques, scene.contacts).tolist(), strict=True
        ):
            if abs(twist) > LEAST_FORCE:
                center, axis = contact - BEYOND * size * normal, np.sign(twist) * normal
                annotations.turn(center, axis, abs(twist), TWIST * size, ARC_ROD * size, FORCE)
        self._load.draw(annotations, pose.position, share)

    def _extent(self) -> Floats:
        """Points that must be in the picture, shape (n, 3) [m]: everything at the end, and where it was planned."""
        recording = self._recording
        corners, contacts = self._triangles.reshape(-1, 3), recording.experiment.scene.contacts
        points = [corners]
        for simulation in range(len(recording.trial.caps)):
            pose = drawn_pose(recording, recording.steps - 1, simulation, self.factor)
            points.append(extent(corners, contacts, pose, self._load))
        return np.concatenate(points)

    def _labels(self, pose: DrawnPose, triangles: Floats) -> list[Label]:
        inside = pose.contacts + LABEL_DEPTH * self._size * pose.normals
        outside = pose.contacts - ABOVE * self._size * pose.normals
        places = self.view.pixels(inside, self.width, self.height)
        seen = open_to(triangles, outside, self.view.axes[2])
        return [
            Label(column=column, row=row, hidden=not open)
            for (column, row), open in zip(places.tolist(), seen.tolist(), strict=True)
        ]


def _shining_through(pixels: Pixels, arrows: Pixels) -> Pixels:
    """A picture in which arrows that the object or a cone hides are faintly seen.

    Args:
        pixels: The picture, shape (height, width, 3).
        arrows: The same with nothing but arrows and fingertips before the background.
    """
    drawn = (arrows != np.array(rgb(BACKGROUND), dtype=np.uint8)).any(axis=2, keepdims=True)
    return np.where(drawn, (1 - GLOW) * pixels + GLOW * arrows, pixels).round().astype(np.uint8)
