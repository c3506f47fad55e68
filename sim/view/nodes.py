"""Parts of the page's scene that move: arrows, fingers and the load. Each is made once, and `show` puts it in place."""

import numpy as np
import trimesh
import viser
from scipy.spatial.transform import Rotation

from planner.arrays import Floats, Indices
from planner.contacts import contact_frames
from sim.render.load import TURN, Load
from sim.render.palette import CONE, FORCE, LOAD, TIP, rgb
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
    arc,
    arc_head,
    arrow_head,
)

SIDES = 48
"""Of cones and arrows."""
RINGS = 5
"""Of vertices of an arrow: foot, rim of the foot, neck, rim of the head, tip."""
LETTERS = 1.3
"""Size of the contacts' numbers, relative to viser's."""
UNSHOWN = np.zeros((1, 2, 3))
"""Points of lines that are not shown yet."""


class Arrow:
    """One arrow: a surface of revolution."""

    def __init__(self, scene: viser.SceneApi, name: str, color: str) -> None:
        rings = np.arange(SIDES * (RINGS - 1)).reshape(-1, SIDES)
        corners = (rings, np.roll(rings, -1, axis=1), rings + SIDES, np.roll(rings, -1, axis=1) + SIDES)
        first, beside, above, across = (ring.ravel() for ring in corners)
        faces = np.concatenate([np.stack([first, beside, above], axis=1), np.stack([beside, across, above], axis=1)])
        vertices = np.zeros((SIDES * RINGS, 3))
        self.node = scene.add_mesh_simple(
            name, vertices, faces, color=rgb(color), flat_shading=True, side="double", visible=False
        )

    def show(self, tip: Floats, vector: Floats, radius: float, head: tuple[float, float] | None = None) -> None:
        """Let it end at `tip`; `head` is the length and radius of the head, by default in proportion."""
        length = float(np.linalg.norm(vector))
        axis, first, second = contact_frames(vector[None] / length)[0].T
        head_length, head_radius = head or arrow_head(length, radius)
        neck = length - head_length
        profile = ((0.0, 0.0), (0.0, radius), (neck, radius), (neck, head_radius), (length, 0.0))
        angles = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)
        circle = np.outer(np.cos(angles), first) + np.outer(np.sin(angles), second)
        self.node.vertices = np.concatenate([tip - vector + along * axis + wide * circle for along, wide in profile])
        self.node.visible = True

    def hide(self) -> None:
        """Show none."""
        self.node.visible = False


class Turn:
    """An arc with a head that says which way it turns."""

    def __init__(self, scene: viser.SceneApi, name: str, color: str) -> None:
        self.arc = scene.add_line_segments(f"{name}/arc", UNSHOWN, rgb(color), thickness=2 * ARC_ROD, visible=False)
        self.head = Arrow(scene, f"{name}/head", color)

    def show(self, center: Floats, axis: Floats, share: float, size: float, rod: float) -> None:
        """A part of the full arc about a unit axis; `size` is its radius, `rod` that of its line."""
        points, heading = arc(axis, share, size)
        points = center + points
        self.arc.points, self.arc.visible = np.stack([points[:-1], points[1:]], axis=1), True
        length, radius = arc_head(share, rod)
        self.head.show(points[-1] + length * heading, length * heading, rod, (length, radius))

    def hide(self) -> None:
        """Show none."""
        self.arc.visible = False
        self.head.hide()


class Finger:
    """A fingertip, its friction cone, its force, its torque and its number."""

    def __init__(self, scene: viser.SceneApi, name: str, number: int, friction: float) -> None:
        self.tip = scene.add_icosphere(f"{name}/tip", radius=1.0, color=rgb(TIP))
        vertices, faces = _cone(friction)
        self.cone = scene.add_mesh_simple(
            f"{name}/cone",
            vertices,
            faces,
            color=rgb(CONE),
            opacity=CONE_OPACITY,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        self.force = Arrow(scene, f"{name}/force", FORCE)
        self.torque = Turn(scene, f"{name}/torque", FORCE)
        self.label = scene.add_label(f"{name}/number", str(number), anchor="center-center", font_screen_scale=LETTERS)

    def show(self, tip: Floats, contact: Floats, frame: Floats, force: Floats, twist: float) -> None:
        """Put it in place; as in the pictures, cones are outside, where the arrows are.

        Args:
            tip: Centre of the fingertip, shape (3,).
            contact: Where it faces the object, shape (3,).
            frame: R_WC, its first column the inward normal, shape (3, 3).
            force: On the object, relative to rho, shape (3,).
            twist: The torque on it about the inward normal, as a part of a full arc.
        """
        self.tip.position, self.tip.radius = tip, float(np.linalg.norm(contact - tip))
        self.cone.position, self.cone.wxyz = contact, quaternion(frame)
        self.label.position = contact + LABEL_DEPTH * frame[:, 0]
        if np.linalg.norm(force) > LEAST_FORCE:
            self.force.show(contact, ARROW * force, SHAFT)
        else:
            self.force.hide()
        if abs(twist) > LEAST_FORCE:
            self.torque.show(contact - BEYOND * frame[:, 0], np.sign(twist) * frame[:, 0], abs(twist), TWIST, ARC_ROD)
        else:
            self.torque.hide()


class Push:
    """The wrench that pushes on the object: its force as an arrow, its moment as an arc."""

    def __init__(self, scene: viser.SceneApi, name: str) -> None:
        self.force = Arrow(scene, f"{name}/force", LOAD)
        self.moment = Turn(scene, f"{name}/moment", LOAD)

    def show(self, load: Load, shift: Floats, share: float) -> None:
        """A part of the load on an object that has moved by `shift`, shape (3,)."""
        if share > 0 and load.force.any():
            self.force.show(load.tip_at(share) + shift, share * load.force, SHAFT * load.size)
        else:
            self.force.hide()
        if share > 0 and load.moment.any():
            axis = load.moment / np.linalg.norm(load.moment)
            self.moment.show(load.center + shift, axis, share, TURN * load.size, ARC_ROD * load.size)
        else:
            self.moment.hide()


def quaternion(rotation: Floats) -> Floats:
    """A rotation matrix as (w, x, y, z), shape (4,)."""
    return Rotation.from_matrix(rotation).as_quat(scalar_first=True)


def _cone(friction: float) -> tuple[Floats, Indices]:
    """A friction cone in its contact frame, mirrored to the outside: its apex at the origin, opening along -x."""
    cone = trimesh.creation.cone(radius=friction * CONE_HEIGHT, height=CONE_HEIGHT, sections=SIDES)
    opening_down = cone.vertices - [0, 0, CONE_HEIGHT]
    return opening_down[:, [2, 0, 1]], cone.faces
