"""A grasp as a 3-D scene in one GLB file: the object, its contacts with their friction cones, forces and torques.

Body frame, metres. Forces are drawn to scale: rho is FORCE_LENGTH of the object's size. So are the torques of soft
fingers, arcs about the normals: a FULL_TURN is the most torque that a finger pressing with rho holds.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np
import trimesh

from planner.arrays import Floats
from planner.errors import GraspFileError
from planner.files.atomic_write import write_atomically
from planner.grasps.grasp import Grasp
from planner.grasps.lift import in_space
from planner.objects.graspable import Graspable
from planner.objects.vectors import unit_arc

CONE_HEIGHT = 0.1
"""Height of a drawn friction cone, relative to the object's size."""

FORCE_LENGTH = 0.4
"""Length of a force arrow of rho, relative to the object's size."""

SHAFT = 0.006
"""Radius of arrows and arcs, relative to the object's size."""

TORQUE_RADIUS, TORQUE_AT = 0.05, 0.16
"""Radius of a torque's arc, and how far outside the contact it stands, relative to the object's size."""

FULL_TURN, ARC_PIECES = 1.4 * np.pi, 32
"""The longest arc [rad], and of how many rods it is made."""

LEAST_TURN = 1e-3
"""Part of it that is still drawn."""

OBJECT_COLOR, CONE_COLOR, FORCE_COLOR = (170, 180, 195, 140), (240, 190, 60, 150), (200, 40, 40, 255)
"""Red, green, blue, opacity."""


def grasp_scene(rigid_object: Graspable, grasp: Grasp, wrench: int) -> trimesh.Scene:
    """The object, a friction cone inside each contact, and the forces and torques that balance one wrench of the task.

    Args:
        rigid_object: What is grasped; a planar object is shown as a slab.
        grasp: The grasp.
        wrench: Which wrench's forces and torques to draw.

    Raises:
        GraspFileError: When the grasp has no contacts or no such wrench.
    """
    if not grasp.found or not 0 <= wrench < len(grasp.forces):
        raise GraspFileError(f"wrench {wrench} of a grasp with forces for wrenches 0 to {len(grasp.forces) - 1}")
    rigid_object, grasp = in_space(rigid_object, grasp)
    size = rigid_object.size
    scene = trimesh.Scene()
    for number, part in enumerate(rigid_object.parts):
        triangles, _ = part.triangles()
        mesh = trimesh.Trimesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3), process=False)
        _add(scene, f"object/{number}/{part.geom}", mesh, OBJECT_COLOR)
    contacts = grasp.contacts
    for finger, (point, normal, friction, force) in enumerate(
        zip(contacts.points, contacts.normals, contacts.friction, grasp.forces[wrench], strict=True)
    ):
        cone = trimesh.creation.cone(radius=friction * CONE_HEIGHT * size, height=CONE_HEIGHT * size)
        cone.apply_transform(_from_apex(point, normal, CONE_HEIGHT * size))
        _add(scene, f"cone/{finger}", cone, CONE_COLOR)
        pushed = FORCE_LENGTH * size * force / grasp.rho
        if pushed.any():
            _add(scene, f"force/{finger}", _arrow(point, pushed, SHAFT * size), FORCE_COLOR)
    largest = float((contacts.torsions * contacts.strengths).max()) * grasp.rho
    for finger, (point, normal, torque) in enumerate(
        zip(contacts.points, contacts.normals, grasp.torques[wrench].tolist(), strict=True)
    ):
        if abs(torque) > LEAST_TURN * largest:
            turned = _arc(point - TORQUE_AT * size * normal, np.sign(torque) * normal, abs(torque) / largest, size)
            _add(scene, f"torque/{finger}", turned, FORCE_COLOR)
    return scene


def write_glb(path: Path, rigid_object: Graspable, grasp: Grasp, wrench: int | None = None) -> None:
    """Write the scene of a grasp, by default with the forces of its critical wrench.

    Raises:
        GraspFileError: When there is nothing to draw.
        OutputError: When the file cannot be written.
    """
    shown = wrench if wrench is not None else (grasp.critical_wrench if grasp.found else -1)
    write_atomically(path, grasp_scene(rigid_object, grasp, shown).export(file_type="glb"))


def _add(scene: trimesh.Scene, name: str, mesh: trimesh.Trimesh, color: tuple[int, int, int, int]) -> None:
    material = trimesh.visual.material.PBRMaterial(
        baseColorFactor=color, alphaMode="OPAQUE" if color[3] == 255 else "BLEND", doubleSided=True
    )
    mesh.visual = trimesh.visual.TextureVisuals(material=material)
    scene.add_geometry(mesh, node_name=name, geom_name=name)


def _from_apex(point: Floats, axis: Floats, height: float) -> Floats:
    """Places a cone that stands on the xy plane with its apex at `point`, opening along `axis`."""
    transform = trimesh.geometry.align_vectors([0, 0, -1], axis)
    transform[:3, 3] = point + height * axis
    return transform


def _arrow(tip: Floats, force: Floats, radius: float) -> trimesh.Trimesh:
    """An arrow of the length of `force` that ends at `tip`."""
    length = float(np.linalg.norm(force))
    head = min(5 * radius, length)
    shaft = trimesh.creation.cylinder(radius=radius, height=length)
    shaft.apply_translation([0, 0, -length / 2 - 0.5 * head])
    point = trimesh.creation.cone(radius=2.5 * radius, height=head)
    point.apply_translation([0, 0, -head])
    arrow = trimesh.util.concatenate([shaft, point])
    transform = trimesh.geometry.align_vectors([0, 0, 1], force / length)
    transform[:3, 3] = tip
    arrow.apply_transform(transform)
    return arrow


def _arc(center: Floats, axis: Floats, share: float, size: float) -> trimesh.Trimesh:
    """A part of a full arc about a unit axis, right-handed, with a head; `size` is the object's."""
    circle, heading = unit_arc(axis, share * FULL_TURN, max(1, round(share * ARC_PIECES)))
    points = center + TORQUE_RADIUS * size * circle
    rods = [trimesh.creation.cylinder(radius=SHAFT * size, segment=ends, sections=12) for ends in pairwise(points)]
    length = min(5 * SHAFT, TORQUE_RADIUS * share * FULL_TURN) * size
    return trimesh.util.concatenate([*rods, _arrow(points[-1] + length * heading, length * heading, SHAFT * size)])
