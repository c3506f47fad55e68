"""Taking out of a file what is only seen, where MuJoCo cannot compile it; physics does not need it."""

import mujoco
import numpy as np

from planner.objects.mjcf.collides import only_seen

GRAIN = 1e-4
"""Radius of what stands for the mass of a mesh that is left out [m]."""

FLAT = ("volume is too small", "surface area is too small", "coplanar")
"""What MuJoCo says of meshes without a volume."""

MASSLESS = "mass and inertia of moving bodies"
"""What it says of moving bodies without mass."""


def without_culprit(spec: mujoco.MjSpec, complaint: str) -> str | None:
    """Take out what a complaint of the compiler is about, if it is only seen.

    Args:
        spec: What could not be compiled; it is changed.
        complaint: MuJoCo's words.

    Returns:
        What the user should know, or None if nothing can be taken out.
    """
    culprit = next((mesh for mesh in spec.meshes if _is_about(complaint, mesh)), None)
    if culprit is not None:
        users = {geom for geom in spec.geoms if geom.meshname == culprit.name}
        return _leave_out(spec, culprit, users, complaint) if users <= set(only_seen(spec)) else None
    if spec.textures:
        _take_off_textures(spec)
        return f"compiled without its textures: {_first_line(complaint)}"
    return None


def advice(complaint: str) -> str:
    """What to do about a complaint, to be put after it; empty where MuJoCo's words are enough."""
    if any(words in complaint for words in FLAT):
        return (
            "; a mesh that collides needs a volume: replace it by a thin box, or switch its collisions off "
            '(contype="0" conaffinity="0")'
        )
    if MASSLESS in complaint:
        return "; where the file has no mass, give the object's with --mass"
    return ""


def _leave_out(spec: mujoco.MjSpec, mesh: mujoco.MjsMesh, users: set[mujoco.MjsGeom], complaint: str) -> str:
    """Replace the geoms of a mesh by grains of the same mass, if it is stated, and delete the mesh."""
    name = mesh.name
    unweighed = any(np.isnan(geom.mass) and not geom.parent.explicitinertial for geom in users)
    for geom in users:
        geom.type, geom.meshname, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, "", [GRAIN, 0, 0]
        geom.mass = 0.0 if np.isnan(geom.mass) else geom.mass
    spec.delete(mesh)
    weight = "; what it would weigh is not counted, give the object's mass with --mass" if unweighed else ""
    return f"planned without mesh '{name}', which is only seen: {_first_line(complaint)}{weight}"


def _take_off_textures(spec: mujoco.MjSpec) -> None:
    for element in [*spec.geoms, *spec.sites, *spec.tendons]:
        element.material = ""
    for asset in [*spec.materials, *spec.textures]:
        spec.delete(asset)


def _is_about(complaint: str, mesh: mujoco.MjsMesh) -> bool:
    """Whether a complaint names a mesh, or its file; it may be about something else of that name, and then stays."""
    return f"Element name '{mesh.name}'" in complaint or (bool(mesh.file) and f"'{mesh.file}'" in complaint)


def _first_line(complaint: str) -> str:
    return complaint.splitlines()[0].removeprefix("Error: ")
