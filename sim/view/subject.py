"""What is looked at: one grasp and its object, and the planned pose with the forces for any wrench.

Everything drawn is in the units of the view: the axes of the body frame B, the reference point as origin, the object's
size (its diagonal) as metre and rho as newton. A die and a car look alike.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.errors import GraspFileError
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import SUFFIX, read_grasp
from planner.grasps.grasped_object import read_grasped_object
from planner.grasps.lift import in_space
from planner.objects.graspable import Graspable
from planner.objects.rigid_object import RigidObject
from sim.render.drawn_motion import DrawnPose
from sim.render.load import Load, placed_load
from sim.render.outline import visible_edges
from sim.render.view import View, best_direction
from sim.scene.units import Units

TIP_RADIUS = 0.012
"""Radius of a planned fingertip, which has none, relative to the object's size."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """A grasp that was found, in space."""

    name: str
    rigid_object: RigidObject
    grasp: Grasp

    @property
    def units(self) -> Units:
        """From the body frame in SI to the units of the view."""
        return Units(
            reference_point=self.grasp.task.reference_point,
            length=1 / self.rigid_object.size,
            force=1 / self.grasp.rho,
        )

    @property
    def contacts(self) -> Contacts:
        """The grasp in the units of the view."""
        return self.units.contacts(self.grasp.contacts)

    @cached_property
    def triangles(self) -> Floats:
        """Of the object's surface, shape (triangles, 3, 3)."""
        return self.units.points(np.concatenate([part.triangles()[0] for part in self.rigid_object.parts]))

    @cached_property
    def edges(self) -> Floats:
        """Those that one would draw, shape (edges, 2, 3)."""
        return self.units.points(visible_edges(self.rigid_object))

    @cached_property
    def direction(self) -> View:
        """From where the contacts are seen best; its target and distance mean nothing."""
        azimuth, elevation = best_direction(self.triangles, self.contacts)
        return View(azimuth=azimuth, elevation=elevation, target=np.zeros(3), distance=1.0)

    def load(self, wrench: int) -> Load:
        """A wrench of the task, where it is drawn."""
        asked = self.units.wrenches(self.grasp.task.wrenches[wrench])
        return placed_load(asked, self.triangles, self.direction.axes[2], size=1.0)

    def planned(self, wrench: int) -> DrawnPose:
        """The object where it was planned, held by the planned forces for a wrench."""
        contacts = self.contacts
        return DrawnPose(
            position=np.zeros(3),
            rotation=np.eye(3),
            tips=contacts.points - TIP_RADIUS * contacts.normals,
            contacts=contacts.points,
            normals=contacts.normals,
            forces=self.grasp.forces[wrench] * self.units.force,
            torques=self.grasp.torques[wrench] * self.units.force * self.units.length,
        )


def subject(name: str, rigid_object: Graspable, grasp: Grasp) -> Subject:
    """What is looked at; a planar object as a slab.

    Raises:
        GraspFileError: When there is no grasp.
    """
    if not grasp.found:
        raise GraspFileError(f"{name} holds no grasp (status {grasp.status}), so there is nothing to look at")
    rigid_object, grasp = in_space(rigid_object, grasp)
    return Subject(name=name, rigid_object=rigid_object, grasp=grasp)


def read_subject(file: Path, moved: Path | None = None) -> Subject:
    """The subject of a grasp file.

    Args:
        file: A *.grasp.json.
        moved: Where the object's file is now; by default where the grasp says.

    Raises:
        GraspFileError: When the file cannot be read, holds no grasp, or is not about this object.
        ObjectError: When the object cannot be read.
    """
    grasp = read_grasp(file)
    return subject(file.name.removesuffix(SUFFIX), read_grasped_object(grasp, moved), grasp)
