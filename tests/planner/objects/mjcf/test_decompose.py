"""A hollow that MuJoCo fills is open in the decomposed object."""

import sys
from pathlib import Path

import numpy as np
import pytest

import planner.objects.mjcf.decompose
from planner.errors import ObjectError
from planner.objects.mjcf.decompose import decompose
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from tests.strategies.cups import HALF, WALL, box_cup, mesh_cup

pytestmark = pytest.mark.slow


@pytest.fixture
def coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Settings that cut a cup in seconds."""
    quick = {
        "mcts_iterations": 10,
        "mcts_nodes": 8,
        "mcts_max_depth": 1,
        "resolution": 200,
        "threshold": 0.1,
        "preprocess_mode": "off",
    }
    monkeypatch.setattr(planner.objects.mjcf.decompose, "SETTINGS", planner.objects.mjcf.decompose.SETTINGS | quick)


@pytest.mark.usefixtures("coarse")
def test_a_filled_cup_is_opened_in_a_file_of_its_own(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    pytest.importorskip("coacd", reason="the extra `decompose` is not installed")
    home, out = tmp_path / "home", tmp_path / "out"
    home.mkdir()
    out.mkdir()
    original = mesh_cup(home)
    before = sorted(home.iterdir())
    source, parts = decompose(ObjectSource(file=original), out)
    file = source.file
    assert sorted(home.iterdir()) == before
    assert file.parent == out
    filled, opened = read_object(original), read_object(file)
    assert "shell" in caplog.text  # the warning of the original, and no other
    assert len(caplog.messages) == 1
    assert len(opened.parts) == parts > 3
    inside = np.random.default_rng(0).uniform(-0.9, 0.9, (500, 3)) * (HALF - WALL) + [0, 0, WALL]
    assert (filled.parts[0].depth(inside[inside[:, 2] < HALF]) > 0).all()
    assert np.max([part.depth(inside) for part in opened.parts], axis=0).max() < WALL / 2
    assert opened.parts[0].friction == 0.4
    assert opened.body == "cup"
    assert opened.mass == pytest.approx(filled.mass)
    stamp = file.stat().st_mtime_ns
    again, same = decompose(ObjectSource(file=original), out)
    assert (again.file, same) == (file, parts)
    assert file.stat().st_mtime_ns == stamp


def test_an_object_without_hollows_is_planned_on_as_it_is(tmp_path: Path) -> None:
    source = ObjectSource(file=box_cup(tmp_path))
    assert decompose(source, tmp_path) == (source, 5)


def test_without_coacd_the_error_says_how_to_get_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "coacd", None)
    with pytest.raises(ObjectError, match=r"pip install 'rhograsp\[decompose\]'"):
        decompose(ObjectSource(file=mesh_cup(tmp_path)), tmp_path)
    assert not list(tmp_path.glob("*.convex.xml"))
