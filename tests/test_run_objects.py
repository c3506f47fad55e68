"""The script that plans and validates every object of a folder."""

import subprocess
import sys
from pathlib import Path

import pytest

from scripts.run_objects import objects
from tests.strategies.mjcf_files import SHARED, SHARED_OBJECTS, written
from tests.tools.commands import ASSETS, ROOT

pytestmark = pytest.mark.slow

SCRIPT = ROOT / "scripts" / "run_objects.py"


def run_script(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, SCRIPT, *arguments]
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)


def test_objects_are_the_files_that_no_other_file_includes(tmp_path: Path) -> None:
    home = tmp_path / "thing"
    home.mkdir()
    written(home, "<mujocoinclude><geom size='.1'/></mujocoinclude>", "fragment.xml")
    written(home, "<mujoco><worldbody><body><include file='fragment.xml'/></body></worldbody></mujoco>", "model.xml")
    written(home, "<mujoco><include file='model.xml'/></mujoco>", "scene.xml")
    (tmp_path / "broken").mkdir()
    written(tmp_path / "broken", "<mujoco", "broken.xml")
    assert [path.name for path in objects(tmp_path)] == ["broken.xml", "scene.xml"]
    assert len(objects(ASSETS)) == len(list(ASSETS.glob("*/*.xml")))


def test_the_shared_folder_holds_the_shared_objects() -> None:
    if not SHARED.is_dir():
        pytest.skip("the shared objects are not here")
    assert objects(SHARED) == sorted((SHARED / name).resolve() for name in SHARED_OBJECTS)


def test_a_table_of_four_rows_per_object_is_printed_and_saved(tmp_path: Path) -> None:
    (tmp_path / "ball").mkdir()
    written(tmp_path / "ball", "<mujoco><worldbody><body><geom size='.03'/></body></worldbody></mujoco>", "ball.xml")
    out = tmp_path / "table.md"
    done = run_script(tmp_path, "--candidates", 40, "--no-measure", "--out", out)
    assert done.returncode == 0, done.stderr
    assert out.read_text() == done.stdout
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()]
    assert [row[:3] for row in rows[2:]] == [["ball", task, m] for task in ("gravity", "paper") for m in ("3", "4")]
    assert {row[7] for row in rows[2:]} == {"pass"}
    assert {len(row) for row in rows} == {9}


def test_an_object_that_cannot_be_read_fails_the_run(tmp_path: Path) -> None:
    (tmp_path / "bad").mkdir()
    written(tmp_path / "bad", "<mujoco><worldbody><body/></worldbody></mujoco>")
    done = run_script(tmp_path)
    assert done.returncode == 5
    assert "| bad | no body of the file collides" in done.stdout
    done = run_script(tmp_path / "nowhere", "--quiet")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("error: there is no folder")
