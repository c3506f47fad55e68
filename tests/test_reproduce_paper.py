"""The script that reproduces the paper's numerical section runs, agrees with the paper, and draws its figures."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.tools.commands import ROOT, says

pytestmark = pytest.mark.slow


def test_the_quick_reproduction_prints_the_papers_numbers_and_saves_its_figures(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "scripts" / "reproduce_paper.py"), "--quick", "--out", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    assert says(done.stdout, r"rho\* \[N\] \| 0.669 \| 0.66900 \|")
    assert says(done.stdout, r"feet of the perpendiculars \[N\] \| 0.718 \| 0.71843 \|")
    assert says(done.stdout, "not the paper's")
    assert (tmp_path / "paper.md").read_text() == done.stdout.removesuffix("\n")
    for name in ("convex", "concave", "prism"):
        assert (tmp_path / f"{name}.png").read_bytes()[:4] == b"\x89PNG"
