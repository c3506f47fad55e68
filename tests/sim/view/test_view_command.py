"""`grasp-view` as users meet it."""

import os
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from tests.tools.commands import ROOT, heavy_after_help, run, says

pytestmark = pytest.mark.slow


def test_ctrl_c_ends_it_cleanly(golden_file: Path) -> None:
    pytest.importorskip("viser", reason="the live view needs the extra viz")
    command = [sys.executable, str(ROOT / "scripts" / "view.py"), str(golden_file), "--no-open", "--port", "0"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout is not None
            line = process.stdout.readline()
            assert says(line, r"^view http://localhost:\d+ \(Ctrl-C ends it\)")
            with urllib.request.urlopen(line.split()[1], timeout=10) as answer:
                assert answer.status == 200
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=30)
        finally:
            process.kill()
    said = [line for line in err.splitlines() if not line.startswith("\N{HORIZONTAL ELLIPSIS}")]  # of a busy machine
    assert (process.returncode, out, said) == (0, "", [])


def test_without_viser_one_line_names_the_extra(
    golden_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    assert run("grasp-view", golden_file, "--no-open") == 1
    told = capsys.readouterr().err
    assert told == "error: the live view needs viser; install it with: pip install 'rhograsp[viz]'\n"


def test_bad_options_are_refused_with_a_reason(
    golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("viser", reason="the live view needs the extra viz")
    for arguments, message in (
        ((), "no grasp file named"),
        ((golden_file, golden_file, "--object", "x.xml"), "--object is for a single file; 2 are named"),
        ((tmp_path / "nowhere.grasp.json",), r"nowhere\.grasp\.json"),
        ((golden_file, "--port", 70000), "port 70000"),
    ):
        assert run("grasp-view", *arguments, "--no-open") == 1, arguments
        assert says(capsys.readouterr().err, f"^error: .*{message}"), arguments


def test_help_loads_nothing_heavy() -> None:
    heavy, printed = heavy_after_help("view", "mujoco", "cvxpy", "scipy", "trimesh", "dm_control", "viser")
    assert not heavy
    assert says(printed, "exit codes: 0 done and proven")
