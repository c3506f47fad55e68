"""Ctrl-C and SIGTERM at any instant of a plan, and a time limit that holds: one line, and a file that is true."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from planner.grasps.grasp_file import read_grasp
from tests.tools.commands import ASSETS, ROOT

LIFE = 4.0
"""Roughly how long the commands live after Python has started, imports included [s]."""

SCRIPT = ROOT / "scripts" / "plan.py"


def started(*arguments: object) -> subprocess.Popen[str]:
    """A plan that runs and watches signals; until then they are Python's own business."""
    command = [str(part) for part in (sys.executable, SCRIPT, *arguments)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not watches(process.pid):
        time.sleep(0.001)
    return process


def watches(pid: int) -> bool:
    """Whether a process has a handler of its own for SIGTERM."""
    caught = next(line for line in Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith("SigCgt"))
    return bool(int(caught.split()[1], 16) >> (signal.SIGTERM - 1) & 1)


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_at_any_instant_a_signal_leaves_one_line_and_no_half_truth(how: signal.Signals, tmp_path: Path) -> None:
    generator = np.random.default_rng(int(how))
    codes = []
    for number, instant in enumerate(generator.uniform(0, LIFE, 10)):
        out = tmp_path / f"{number}.grasp.json"
        process = started(ASSETS / "box" / "box.xml", "--fingers", 5, "--candidates", 300, "--out", out)
        time.sleep(instant)
        process.send_signal(how)
        _, err = process.communicate(timeout=60)
        codes.append(process.returncode)
        assert process.returncode in (0, 4, 130), err
        assert "Traceback" not in err and "Error" not in err
        said = [line for line in err.splitlines() if not line.startswith("\N{HORIZONTAL ELLIPSIS}")]
        assert len(said) <= 1
        assert out.exists() == (process.returncode != 130)
        if out.exists():
            grasp = read_grasp(out)
            assert (grasp.status == "optimal") == (process.returncode == 0)
            assert grasp.lower_bound <= grasp.rho
    assert 130 in codes  # some came before there was a grasp


def test_a_second_signal_ends_at_once(tmp_path: Path) -> None:
    process = started(
        ASSETS / "mug" / "mug.xml", "--fingers", 5, "--candidates", 800, "--out", tmp_path / "a.grasp.json"
    )
    assert process.stdout is not None
    for line in process.stdout:
        if line.split()[:2] == ["0", "1"]:
            break
    os.kill(process.pid, signal.SIGTERM)
    os.kill(process.pid, signal.SIGINT)
    process.communicate(timeout=20)
    assert process.returncode in (4, 130)


@pytest.mark.parametrize(("candidates", "fingers"), [(30_000, 3), (1000, 8)])
def test_the_time_limit_holds_for_the_whole_command(candidates: int, fingers: int, tmp_path: Path) -> None:
    out, limit = tmp_path / "a.grasp.json", 0.5
    command = f"""
import sys, time
from planner.terminal.interruption import Interruption
start_clock = Interruption.start_clock
def noted(self, limit):
    print("CLOCK", time.time(), file=sys.stderr, flush=True)
    start_clock(self, limit)
Interruption.start_clock = noted
sys.argv = ["grasp-plan", {str(ASSETS / "mug" / "mug.xml")!r}, "--candidates", "{candidates}", "--fingers", "{fingers}",
            "--out", {str(out)!r}, "--time-limit", "{limit}"]
from planner.commands.start import plan
plan()
"""
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True, cwd=ROOT, check=False)
    ended = time.time()
    began = next(float(line.split()[1]) for line in done.stderr.splitlines() if line.startswith("CLOCK"))
    assert done.returncode == 4
    assert ended - began < limit + 1.5  # half a second, and as much again and more for a busy machine
    if out.exists():
        assert json.loads(out.read_text())["status"] == "time_limit"
    else:
        assert "no grasp found yet" in done.stderr
