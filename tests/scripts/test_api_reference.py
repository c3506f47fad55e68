"""The script that builds the API reference."""

import runpy
import sys
from pathlib import Path

import pytest

from tests.tools.commands import ROOT


def run_script(*arguments: object) -> int:
    """Its exit code."""
    with pytest.MonkeyPatch.context() as patch, pytest.raises(SystemExit) as left:
        patch.setattr(sys, "argv", ["api_reference.py", *map(str, arguments)])
        runpy.run_path(str(ROOT / "scripts" / "api_reference.py"), run_name="__main__")
    return int(left.value.code or 0)


def test_a_module_becomes_a_page_with_its_docstrings(tmp_path: Path) -> None:
    pytest.importorskip("pdoc", reason="an extra")
    assert run_script("--out", tmp_path / "api", "--modules", "planner.search.constraints") == 0
    page = (tmp_path / "api" / "planner" / "search" / "constraints" / "spacing.html").read_text()
    assert "neither too close to each other nor too far apart" in page
    assert (tmp_path / "api" / "index.html").is_file()


def test_without_pdoc_the_script_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "pdoc", None)
    assert run_script("--out", tmp_path) == 1
    assert "pip install 'rhograsp[docs]'" in capsys.readouterr().err
