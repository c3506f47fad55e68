"""What is drawn around a trial: the object that MuJoCo collides, above a plain floor that shows its shadow.

Only drawn, never simulated: the object is put where the recorded trial had it. Fingertips, forces and cones are added
frame by frame (sim/render/panel.py). Units and frame are those of the experiment.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from planner.arrays import Floats
from planner.errors import SimulationError
from planner.objects.rigid_object import RigidObject
from sim.render.palette import BACKGROUND, OBJECT, rgba
from sim.render.view import FIELD, View
from sim.scene.dm_control_mjcf import mjcf
from sim.scene.floating_object import OBJECT as BODY
from sim.scene.part_geom import add_part
from sim.scene.scene import PRECISION
from sim.trial.experiment import Experiment

HEAD = "head"
"""Name of the mesh of arrows' heads."""
FLOOR_WIDTH = 3.2
"""Of the floor, relative to the object's size; beyond it there is only background, of the same colour."""
AMBIENT, HEADLIGHT, KEY, FILL = 0.52, 0.16, 0.36, 0.12
"""Light from everywhere, from the camera, from its upper left and from its right."""
KEY_FROM, FILL_FROM = (-0.55, 0.75, 0.45), (0.9, 0.1, 0.35)
"""Where the last two come from, in camera axes: right, up, towards the camera."""
SIDES = 72
"""Of a cone."""
SHADOW_PIXELS = 384
"""Width of the floor's texture."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DrawnScene:
    """A model to draw."""

    model: mujoco.MjModel

    cones: tuple[int, ...]
    """Mesh of each contact's friction cone: height 1, its apex at the origin, opening along -z."""

    head: int
    """Mesh of an arrow's head, a cone of height and radius 1 like these."""

    shadow: int
    """Texture of the floor."""

    floor: float
    """Height of the floor [m]."""

    floor_half: float
    """Half of the floor's width; its middle is below the reference point [m]."""


def drawn_scene(
    rigid_object: RigidObject, experiment: Experiment, view: View, floor: float, width: int, height: int
) -> DrawnScene:
    """Compose and compile the model.

    Args:
        rigid_object: What is held, in the body frame, SI.
        experiment: Its units and contacts.
        view: The light follows the camera.
        floor: Height of the floor [m of the experiment].
        width: Of the pictures [pixels].
        height: Of the pictures [pixels].

    Raises:
        SimulationError: When MuJoCo cannot compile it.
    """
    units, friction = experiment.units, experiment.scene.contacts.friction
    size = rigid_object.size * units.length
    root = mjcf.RootElement(model="stage")
    _set_quality(root, size, width, height)
    _add_light(root, view)
    _add_floor(root, floor, FLOOR_WIDTH * size / 2)
    root.asset.add("material", name="object", rgba=rgba(OBJECT), specular=0.2, shininess=0.3)
    body = root.worldbody.add("body", name=BODY, mocap=True)
    for index, part in enumerate(rigid_object.parts):
        add_part(body, f"part_{index}", part, units).material = "object"
    names = [f"cone_{finger}" for finger in range(len(friction))]
    for name, radius in zip([*names, HEAD], [*friction, 1.0], strict=True):
        root.asset.add("mesh", name=name, vertex=_cone(radius).ravel(), inertia="convex")
    try:
        model = mujoco.MjModel.from_xml_string(root.to_xml_string(precision=PRECISION), root.get_assets())
    except ValueError as error:
        raise SimulationError(f"MuJoCo cannot compile the scene to draw: {error}") from error
    return DrawnScene(
        model=model,
        cones=tuple(model.mesh(name).id for name in names),
        head=model.mesh(HEAD).id,
        shadow=model.texture("shadow").id,
        floor=floor,
        floor_half=FLOOR_WIDTH * size / 2,
    )


def _set_quality(root: mjcf.RootElement, size: float, width: int, height: int) -> None:
    root.visual.get_children("global").set_attributes(offwidth=width, offheight=height, fovy=FIELD)
    root.visual.quality.set_attributes(shadowsize=0, offsamples=8, numslices=48, numstacks=24)
    root.visual.map.set_attributes(znear=0.05, zfar=100)
    root.statistic.set_attributes(extent=size, center=np.zeros(3))


def _add_light(root: mjcf.RootElement, view: View) -> None:
    root.visual.headlight.set_attributes(ambient=[AMBIENT] * 3, diffuse=[HEADLIGHT] * 3, specular=[0.1] * 3)
    for strength, source in ((KEY, KEY_FROM), (FILL, FILL_FROM)):
        towards = view.axes.T @ np.array(source)
        root.worldbody.add(
            "light",
            type="directional",
            pos=towards,
            dir=-towards,
            diffuse=[strength] * 3,
            ambient=np.zeros(3),
            specular=[0.1] * 3,
            castshadow=False,
        )


def _add_floor(root: mjcf.RootElement, height: float, half: float) -> None:
    """A floor that glows in the colour of the background, except where its texture says shadow."""
    color = rgba(BACKGROUND)[:3]
    root.asset.add("texture", name="sky", type="skybox", builtin="flat", rgb1=color, rgb2=color, width=16, height=96)
    root.asset.add(
        "texture",
        name="shadow",
        type="2d",
        builtin="flat",
        rgb1=color,
        rgb2=color,
        width=SHADOW_PIXELS,
        height=SHADOW_PIXELS,
    )
    root.asset.add("material", name="floor", texture="shadow", rgba=np.ones(4), emission=1, specular=0, shininess=0)
    root.worldbody.add("geom", name="floor", type="plane", size=[half, half, 1], pos=[0, 0, height], material="floor")


def _cone(radius: float) -> Floats:
    """Corners of a cone of height 1, its apex at the origin, opening along -z, shape (SIDES + 1, 3)."""
    angles = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)
    rim = np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(SIDES, -1.0)])
    return np.vstack([np.zeros(3), rim])
