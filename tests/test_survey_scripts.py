"""The scripts that measure many grasps leave their tables and plots where the user says."""

import runpy
import sys
from pathlib import Path

import pytest

from tests.tools.commands import ROOT

pytestmark = pytest.mark.slow


def run_script(name: str, *arguments: object) -> int:
    """Run a script as a user types it; returns its exit code."""
    with pytest.MonkeyPatch.context() as patch, pytest.raises(SystemExit) as left:
        patch.setattr(sys, "argv", [name, *map(str, arguments)])
        runpy.run_path(str(ROOT / "scripts" / f"{name}.py"), run_name="__main__")
    return int(left.value.code or 0)


def test_the_benchmark_of_validations_leaves_a_table_and_a_plot(tmp_path: Path) -> None:
    assert run_script("benchmark_validation", "--quick", "--out", tmp_path / "new" / "folder") == 0
    assert {path.name for path in (tmp_path / "new" / "folder").iterdir()} == {"costs.csv", "costs.png"}


@pytest.mark.parametrize("script", ["benchmark_validation", "measure_all"])
def test_without_matplotlib_a_script_says_so_before_it_works(
    script: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert run_script(script, "--quick", "--out", tmp_path) == 1
    captured = capsys.readouterr()
    assert "pip install" in captured.err and captured.out == ""


def test_a_folder_that_cannot_be_made_is_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").write_text("")
    assert run_script("measure_all", "--quick", "--out", tmp_path / "file" / "folder") == 1
    assert "cannot make the folder" in capsys.readouterr().err
