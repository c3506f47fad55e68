"""A mesh given in place of an object: which MJCF file to write around it."""

from pathlib import Path

from planner.errors import ObjectError

READ_BY_MUJOCO = (".obj", ".stl", ".msh")

MESH_FILES = (*READ_BY_MUJOCO, ".ply", ".off", ".glb", ".gltf", ".dae", ".3mf", ".fbx", ".step", ".stp")
"""How names of files end that hold a shape but no mass, friction or body."""


def refuse_mesh(path: Path) -> None:
    """Refuse a mesh that is given in place of an MJCF file, and say what to write around it.

    Raises:
        ObjectError: If it is one; what cannot be read at all is for the reader to say.
    """
    if path.suffix.lower() not in MESH_FILES:
        return
    try:
        there = path.is_file()
    except OSError:  # a name that no file can have
        return
    if there:
        raise ObjectError(_mjcf_around(path))


def _mjcf_around(path: Path) -> str:
    """What to say of a mesh that is given in place of an MJCF file."""
    if path.suffix.lower() not in READ_BY_MUJOCO:
        return (
            f"'{path}' is a mesh in a format that MuJoCo does not read; convert it to OBJ or STL, in metres, and give "
            "an MJCF file that uses it"
        )
    from xml.sax.saxutils import quoteattr  # here: it brings urllib with all of the web's protocols

    name, file = quoteattr(path.stem), quoteattr(path.name)
    return (
        f"'{path}' is a mesh, which has no mass and no friction; write this as {path.stem}.xml beside it, with its "
        f'mass in kg, and scale="0.001 0.001 0.001" in <mesh> if it is in millimetres: <mujoco><asset><mesh '
        f'name={name} file={file}/></asset><worldbody><body name={name}><freejoint/><geom type="mesh" mesh={name} '
        'mass="0.2" friction="0.5"/></body></worldbody></mujoco>'
    )
