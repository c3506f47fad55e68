"""One compilation serves all steps of a command, as long as nothing it was made from has changed."""

import os
from pathlib import Path

import mujoco
import numpy as np
import pytest

from planner.objects.mjcf.compiled import compile_mjcf
from planner.objects.mjcf.reader import read_object
from planner.objects.mjcf.visual import visual_difference

OBJECT = '<mujoco>{}<worldbody><body name="ball"><freejoint/><geom size="0.0{}"/></body></worldbody></mujoco>'


def written(path: Path, text: str) -> Path:
    """The file, whose size and time of change tell nothing."""
    path.write_text(text)
    os.utime(path, (1e9, 1e9))
    return path


def test_a_file_is_compiled_once_for_all_who_ask(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parsed, from_file = [], mujoco.MjSpec.from_file

    def counted(name: str) -> mujoco.MjSpec:
        parsed.append(name)
        return from_file(name)

    monkeypatch.setattr(mujoco.MjSpec, "from_file", counted)
    path = written(tmp_path / "ball.xml", OBJECT.format("", 2))
    visual_difference(read_object(path))
    assert parsed == [str(path)]
    assert compile_mjcf(path)[0] is compile_mjcf(path)[0]
    compile_mjcf(path, lambda spec: None)
    assert len(parsed) == 2


def test_a_changed_file_is_compiled_again_even_if_its_size_and_time_are_the_same(tmp_path: Path) -> None:
    path = tmp_path / "ball.xml"
    radii = [float(compile_mjcf(written(path, OBJECT.format("", size)))[0].geom_size[0, 0]) for size in (2, 3, 2)]
    assert np.allclose(radii, [0.02, 0.03, 0.02])


def test_a_change_in_an_included_file_is_seen_too(tmp_path: Path) -> None:
    path = written(tmp_path / "ball.xml", OBJECT.format('<include file="more.xml"/>', 2))
    more = '<mujoco><option gravity="0 0 -{}"/></mujoco>'
    pulls = []
    for pull in (1, 9):
        written(tmp_path / "more.xml", more.format(pull))
        pulls.append(compile_mjcf(path)[0].opt.gravity[2])
    assert pulls == [-1, -9]


def test_files_of_the_same_content_in_two_folders_are_two(tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    first, second = (written(tmp_path / name, OBJECT.format("", 2)) for name in ("ball.xml", "other/ball.xml"))
    assert compile_mjcf(first)[0] is not compile_mjcf(second)[0]
