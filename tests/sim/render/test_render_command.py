"""`grasp-render` as users meet it, with and without OpenGL."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

from sim.render.picture import Picture
from tests.tools.commands import ROOT, heavy_after_help, run, says

pytestmark = pytest.mark.slow


def test_the_command_draws_and_says_what_was_seen(
    picture: Picture, golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The fixture `picture` skips this where there is no OpenGL."""
    out = tmp_path / "still.png"
    assert run("grasp-render", golden_file, "--out", out, "--size", 640, 360, "--view", 60, 30) == 0
    said = capsys.readouterr().out
    assert says(said, r"wrench 49 with the cap at 1\.02 of the 0\.669 N it needs: held; .* at 0\.98 .*: slipped; slip")
    assert says(said, "wrote .*still.png")
    with Image.open(out) as still:
        assert still.size == (640, 360)
        assert still.format == "PNG"
        assert len(still.convert("RGB").getcolors(640 * 360) or []) > 1000


def test_bad_options_are_refused_with_a_reason_before_anything_is_drawn(
    golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "x.png"
    for arguments, message in (
        (("--out", tmp_path / "x.jpg"), r"x\.jpg: its ending must be one of \.png, \.gif, \.mp4"),
        (("--out", tmp_path / "no" / "x.png"), "not a writable folder"),
        (("--out", out, "--wrench", 64), "wrench 64 .* 0 to 63"),
        (("--out", out, "--size", 64, 36), "64 x 36"),
    ):
        assert run("grasp-render", golden_file, *arguments) == 1, arguments
        assert says(capsys.readouterr().err, f"^error: .*{message}"), arguments
    assert run("grasp-render", tmp_path / "nowhere.grasp.json", "--out", out) == 1
    assert says(capsys.readouterr().err, "nowhere.grasp.json")
    assert not out.exists()


@pytest.mark.parametrize(
    ("setting", "value", "reason"),
    [
        ("MUJOCO_GL", "disable", "MUJOCO_GL is disable"),  # MuJoCo has no OpenGL, and works
        ("MUJOCO_GL", "cuneiform", "MUJOCO_GL is cuneiform"),  # MuJoCo cannot even be imported
        ("PYOPENGL_PLATFORM", "cuneiform", "MUJOCO_GL is not set"),  # EGL cannot be loaded
    ],
)
def test_without_opengl_one_line_says_what_to_do(
    setting: str, value: str, reason: str, golden_file: Path, tmp_path: Path
) -> None:
    environment = {name: text for name, text in os.environ.items() if name != "MUJOCO_GL"} | {setting: value}
    command = [sys.executable, ROOT / "scripts" / "render.py", golden_file, "--size", "640", "360"]
    done = subprocess.run(
        [str(part) for part in command], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1, done.stderr
    (said,) = [line for line in done.stderr.splitlines() if not line.startswith("\N{HORIZONTAL ELLIPSIS}")]
    assert says(said, f"^error: OpenGL does not work: .*{reason}.*set MUJOCO_GL=egl and install EGL")
    assert list(tmp_path.glob("golden.p*")) == list(tmp_path.glob("*.gif")) == []


def test_help_loads_nothing_heavy() -> None:
    heavy, printed = heavy_after_help("render", "mujoco", "cvxpy", "scipy", "trimesh", "dm_control", "PIL")
    assert not heavy
    assert says(printed, "exit codes: 0 done and proven")
