"""One object with its fingers, its load and a caption in the page's scene: the plan, or one simulation."""

import numpy as np
import trimesh
import viser

from planner.arrays import Floats
from planner.contacts import contact_frames
from planner.pictures.shaded_surface import shaded_surface
from sim.render.drawn_motion import DrawnPose
from sim.render.load import Load
from sim.render.palette import EDGE, GHOST, OBJECT, rgb
from sim.render.proportions import twists
from sim.view.nodes import LETTERS, Finger, Push, quaternion
from sim.view.subject import Subject

EDGE_WIDTH = 1.5
"""Of the object's edges [pixels]."""


class ShownTrial:
    """Made once for a subject; what changes is put in place."""

    def __init__(self, scene: viser.SceneApi, subject: Subject, name: str) -> None:
        """Make the nodes.

        Args:
            scene: Where they are drawn.
            subject: Which object, with which contacts.
            name: Of the node that holds all others.
        """
        self._contacts = subject.contacts
        self.root = scene.add_frame(f"/{name}", show_axes=False)
        self.object = scene.add_frame(f"/{name}/object", show_axes=False)
        self.surface = scene.add_mesh_trimesh(f"/{name}/object/surface", _surface(subject))
        self.ghost = _edges(scene, f"/{name}/planned", subject.edges, GHOST)
        _edges(scene, f"/{name}/object/edges", subject.edges, EDGE)
        self.fingers = [
            Finger(scene, f"/{name}/finger {number}", number, friction)
            for number, friction in enumerate(self._contacts.friction.tolist(), start=1)
        ]
        self.load = Push(scene, f"/{name}/load")
        self.caption = scene.add_label(f"/{name}/caption", "", anchor="center-center", font_screen_scale=LETTERS)

    def show(self, pose: DrawnPose, load: Load, share: float = 1.0) -> None:
        """Put everything where a pose has it, with a part of the load."""
        self.object.position, self.object.wxyz = pose.position, quaternion(pose.rotation)
        turned = twists(pose.torques, self._contacts).tolist()
        columns = (pose.tips, pose.contacts, contact_frames(pose.normals), pose.forces, turned)
        for finger, tip, contact, frame, force, twist in zip(self.fingers, *columns, strict=True):
            finger.show(tip, contact, frame, force, twist)
        self.load.show(load, pose.position, share)

    def say(self, words: str, place: Floats) -> None:
        """A caption at a place relative to the root, shape (3,); none for no words."""
        self.caption.text, self.caption.position, self.caption.visible = words, place, bool(words)

    def place(self, position: Floats, ghost: bool) -> None:
        """Put the whole somewhere, shape (3,), with the edges of where it was planned if asked for."""
        self.root.position = position
        if self.ghost:
            self.ghost.visible = ghost

    def remove(self) -> None:
        """Take all nodes away."""
        self.root.remove()


def _surface(subject: Subject) -> trimesh.Trimesh:
    """The object with its exact normals."""
    corners = np.concatenate([shaded_surface(part) for part in subject.rigid_object.parts])
    mesh = trimesh.Trimesh(
        subject.units.points(corners[:, :3]),
        np.arange(len(corners)).reshape(-1, 3),
        vertex_normals=corners[:, 3:],
        process=False,
    )
    material = trimesh.visual.material.PBRMaterial(
        baseColorFactor=(*rgb(OBJECT), 255), metallicFactor=0.0, roughnessFactor=0.7
    )
    mesh.visual = trimesh.visual.TextureVisuals(material=material)
    return mesh


def _edges(scene: viser.SceneApi, name: str, edges: Floats, color: str) -> viser.LineSegmentsHandle | None:
    """Lines; none for a smooth object."""
    if not len(edges):
        return None
    return scene.add_line_segments(name, edges, rgb(color), thickness=EDGE_WIDTH, thickness_units="screen")
