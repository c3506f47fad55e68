"""One unit for one quantity on the screen: lengths in mm, angles in degrees."""

import re
from pathlib import Path

import pytest

from tests.tools.commands import run

METRES_OR_RADIANS = re.compile(r"(?<![\w.])-?\d[\d.e+-]* (m|cm|rad|µm|um|N mm)\b")

PART = """<mujoco><worldbody><body name="part"><freejoint/>
<geom name="block" type="box" size="0.05 0.03 0.08" mass="8" friction="0.5"/></body></worldbody></mujoco>"""


def test_the_pattern_knows_what_it_looks_for() -> None:
    for wrong in ("moved 0.0012 m, its", "turned by 1e-3 rad", "lies 0.4 µm off", "(3) 5 cm"):
        assert METRES_OR_RADIANS.search(wrong), wrong
    for right in ("moved 1.2 mm", "2 N m", "64 of 64 moved", "3 kg per m3 of 4 cm3", "0.3 m/s2 said"[4:], "5 degrees"):
        assert not METRES_OR_RADIANS.search(right), right


@pytest.mark.slow
def test_no_command_prints_a_length_in_metres_or_an_angle_in_radians(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("part.xml").write_text(PART)
    Path("lift.toml").write_text("set = {kind = 'single', wrench = [0, 0, -78.4, 0, 0, 0]}")
    Path("jaws.csv").write_text("0,0.0300004,0\n0,-0.03,0\n")
    given = ("--fingers", 2, "--task", "lift.toml", "--mass", 8, "--com", 0, 0, 0, "--candidates", "jaws.csv")
    for command, *arguments in (
        ("grasp-inspect", "part.xml", "--candidates", 50),
        ("grasp-plan", "part.xml", *given),
        ("grasp-verify", "part.grasp.json"),
        ("grasp-validate", "part.grasp.json"),
        ("grasp-validate", "part.grasp.json", "--mode", "dexgraspbench"),
        ("grasp-validate", "part.grasp.json", "--mode", "graspdatagen"),
    ):
        run(command, *arguments)
        said = capsys.readouterr().out
        assert len(said.splitlines()) > 1
        assert not METRES_OR_RADIANS.findall(said), said
