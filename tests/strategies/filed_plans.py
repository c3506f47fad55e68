"""Two small plans as files: one of presets and numbers, one of files that the user wrote."""

import json
from pathlib import Path
from typing import Any

from tests.tools.commands import run

HAMMER = """
<mujoco>
  <worldbody>
    <body name="hammer">
      <freejoint/>
      <geom name="handle" type="box" size="0.01 0.01 0.06" mass="0.1" friction="0.8"/>
      <geom name="head" type="box" size="0.03 0.012 0.012" pos="0 0 0.072" mass="0.2" friction="0.5"/>
    </body>
    <body name="peg"><freejoint/><geom name="peg" type="sphere" size="0.01"/></body>
  </worldbody>
</mujoco>
"""

TASK = """
name = "knock"
[set]
kind = "axes6"
acceleration = 20
"""

LIMITS = """
spacing = 0.004
span = 0.2
[[keep_out]]
lower = [-inf, -inf, -inf]
upper = [inf, inf, -0.03]
[[finger]]
[[finger]]
[[finger]]
strength = 0.8
"""

POINTS = """
x,y,z
0.01,0,-0.04
0.01,0,0
0.01,0,0.03
-0.01,0,0
-0.01,0,0.03
0,0.01,0
0,0.01,0.03
0,-0.01,0
0,-0.01,0.03
0.03,0,0.072
-0.03,0,0.072
0.02,0.012,0.072
-0.02,-0.012,0.072
"""


def preset_plan(folder: Path) -> Path:
    """The preset axes6, 24 evenly spread candidates with each geom's own friction."""
    return _planned(folder, "--task", "axes6", "--candidates", "24")


def soft_plan(folder: Path) -> Path:
    """Three fingers with pads of 4 mm radius, which twist."""
    return _planned(folder, "--task", "gravity", "--candidates", "24", "--patch", 0.004)


def filed_plan(folder: Path) -> Path:
    """A task file, a list of points, and limits that remove a point and tell two kinds of fingers apart."""
    (folder / "knock.toml").write_text(TASK)
    (folder / "limits.toml").write_text(LIMITS)
    (folder / "points.csv").write_text(POINTS.strip())
    files = [
        *("--task", folder / "knock.toml"),
        *("--limits", folder / "limits.toml"),
        *("--candidates", folder / "points.csv"),
    ]
    return _planned(folder, *files, "--friction", 0.9, "--friction-error", 0.1)


def _planned(folder: Path, *options: object) -> Path:
    (folder / "hammer.xml").write_text(HAMMER)
    out = folder / "hammer.grasp.json"
    assert run("grasp-plan", folder / "hammer.xml", "--body", "hammer", *options, "--out", out, "--quiet") == 0
    return out


def document_of(file: Path) -> dict[str, Any]:
    """What a grasp file holds."""
    document: dict[str, Any] = json.loads(file.read_text())
    return document
