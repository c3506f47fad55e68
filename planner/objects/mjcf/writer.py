"""An object as one self-contained MJCF file: its convex parts collide, its mass properties are stated.

Meshes are written as vertices, so no other file is needed and the file may lie anywhere.
"""

from collections.abc import Iterable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from planner.arrays import Floats
from planner.files.atomic_write import write_atomically
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.primitives import Primitive
from planner.objects.rigid_object import ConvexPart, RigidObject

SEEN = "seen"
"""Name of the mesh that is only seen."""

REST = "rest"
"""Ends the name of the body around the one that fingers may touch."""


def write_mjcf(path: Path, rigid_object: RigidObject, seen: Floats) -> None:
    """Write an object so that reading it gives the same parts, in the same body frame.

    Args:
        path: The file to write.
        rigid_object: The object.
        seen: Triangles of its visual mesh, shape (n, 3, 3) [m]; n may be 0.

    Raises:
        OutputError: When the file cannot be written.
    """
    root = ElementTree.Element("mujoco", model=rigid_object.body)
    assets = ElementTree.SubElement(root, "asset")
    outer = ElementTree.SubElement(ElementTree.SubElement(root, "worldbody"), "body", name=rigid_object.body)
    if rigid_object.mass > 0:
        ElementTree.SubElement(outer, "freejoint")  # MuJoCo lets nothing without mass move
        _add_inertial(outer, rigid_object)
    body = outer
    if rigid_object.untouchable:  # fingers may touch a body and what is fixed below it, in the same place
        outer.set("name", f"{rigid_object.body}/{REST}")
        body = ElementTree.SubElement(outer, "body", name=rigid_object.body)
    if len(seen):
        vertices, faces = np.unique(seen.reshape(-1, 3), axis=0, return_inverse=True)
        _add_mesh(assets, SEEN, vertices, faces.reshape(-1, 3))
        ElementTree.SubElement(body, "geom", type="mesh", mesh=SEEN, contype="0", conaffinity="0", group="2", mass="0")
    for number, part in enumerate(rigid_object.parts):
        geom = _add_part(assets, outer if number in rigid_object.untouchable else body, number, part)
        if torsion := float(rigid_object.torsions[number]):
            geom.attrib |= {"condim": "4", "friction": f"{part.friction!r} {torsion!r}"}
    ElementTree.indent(root)
    write_atomically(path, ElementTree.tostring(root, encoding="utf-8") + b"\n")


def _add_inertial(body: ElementTree.Element, rigid_object: RigidObject) -> None:
    tensor = rigid_object.inertia
    ElementTree.SubElement(
        body,
        "inertial",
        pos=_numbers(rigid_object.center_of_mass),
        mass=repr(rigid_object.mass),
        fullinertia=_numbers([*np.diag(tensor), tensor[0, 1], tensor[0, 2], tensor[1, 2]]),
    )


def _add_part(
    assets: ElementTree.Element, body: ElementTree.Element, number: int, part: ConvexPart
) -> ElementTree.Element:
    geom = ElementTree.SubElement(body, "geom", name=part.geom, friction=repr(part.friction), group="3", mass="0")
    if isinstance(part, Primitive):
        geom.attrib |= {
            "type": part.mjcf_type,
            "pos": _numbers(part.pose.position),
            "quat": _numbers(part.pose.quaternion),
            "size": _numbers(part.size),
        }
    elif isinstance(part, Polyhedron):
        geom.attrib |= {"type": "mesh", "mesh": f"part{number}"}
        _add_mesh(assets, f"part{number}", part.vertices)
    return geom


def _add_mesh(assets: ElementTree.Element, name: str, vertices: Floats, faces: Iterable[object] = ()) -> None:
    """A mesh; without faces, the hull of its vertices. Inertia "shell", because any surface has one."""
    mesh = ElementTree.SubElement(assets, "mesh", name=name, inertia="shell", vertex=_numbers(vertices))
    corners = np.array(list(faces), dtype=int)
    if corners.size:
        mesh.set("face", " ".join(map(str, corners.ravel().tolist())))


def _numbers(values: object) -> str:
    """Digits that carry doubles through XML unchanged."""
    return " ".join(map(repr, np.asarray(values, dtype=float).ravel().tolist()))
