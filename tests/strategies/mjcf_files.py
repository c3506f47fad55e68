"""MJCF files the tests write, and the shared objects where they are present."""

from pathlib import Path

import pytest

SHARED = Path(__file__).resolve().parents[3] / "shared" / "objects"

SHARED_OBJECTS = {
    "mujoco_mug/mug.xml": ("mug", 34),
    "metaworld_hammer/objects/hammer.xml": ("body1", 6),
    "robosuite_milk/objects/milk.xml": ("body1", 1),
    "prl_plastic_bowl/plastic_bowl.xml": ("plastic_bowl", 1),
    "prl_notebook/notebook.xml": ("notebook", 1),
    "dm_marker/marker.xml": ("body1", 24),
    "ycb_mug/objects/ycb/025_mug.xml": ("object_entity", 16),
    "gso_toy_wagon/scene.xml": ("body1", 14),
    "ycb_dice/dice.xml": ("dice", 4),
    "ycb_power_drill/power_drill.xml": ("power_drill", 4),
}
"""Entry file: the body that is the object, and its number of collision geoms."""

TETRAHEDRON = '<mesh name="tetrahedron" scale="2 1 1" vertex="0 0 0  .1 0 0  0 .1 0  0 0 .1"/>'

EVERY_SHAPE = f"""<mujoco>
  <compiler angle="degree"/>
  <asset>{TETRAHEDRON}</asset>
  <worldbody>
    <light pos="0 0 1"/>
    <geom type="plane" size="1 1 .1"/>
    <body pos="3 -2 1" euler="10 20 30">
      <freejoint/>
      <geom name="mesh" type="mesh" mesh="tetrahedron" pos=".3 0 0" euler="0 40 0" friction=".2"/>
      <geom name="box" type="box" size=".02 .04 .06" pos="0 .3 0" euler="50 0 60"/>
      <geom name="sphere" size=".05"/>
      <geom name="picture" size=".5" contype="0" conaffinity="0" mass="0"/>
      <body pos="0 0 .3" euler="70 0 0">
        <geom name="ellipsoid" type="ellipsoid" size=".02 .04 .06" euler="15 25 35"/>
        <geom type="cylinder" size=".03 .05" pos="0 .3 0" contype="0"/>
        <body euler="0 80 0" pos="-.3 .1 .2">
          <geom name="capsule" type="capsule" size=".03 .05" pos="0 0 .2" conaffinity="0"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>"""
"""One object over three bodies with a geom of every kind; geom 7 has no name."""


def written(folder: Path, text: str, name: str = "object.xml") -> Path:
    """The path of a new file with this text."""
    path = folder / name
    path.write_text(text)
    return path


def world(content: str, assets: str = "") -> str:
    """An MJCF text with this content of the worldbody."""
    return f"<mujoco><asset>{assets}</asset><worldbody>{content}</worldbody></mujoco>"


def shared_object(name: str) -> Path:
    """The path of a shared object; skips the test where there is none."""
    path = SHARED / name
    if not path.is_file():
        pytest.skip(f"the shared object {name} is not here")
    return path
