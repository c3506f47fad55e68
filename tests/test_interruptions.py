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

pytestmark = pytest.mark.slow

LIFE = 4.0
"""Roughly how long the commands live after Python has started, imports included [s]."""

PROMISED = 0.5
"""Largest time beyond its limit that a command takes [s]."""
TRIES = 3
"""Of one limit: a busy machine may be late once."""


def started(*arguments: object, command: str = "plan") -> subprocess.Popen[str]:
    """A command that runs and watches signals; until then they are Python's own business."""
    line = [str(part) for part in (sys.executable, ROOT / "scripts" / f"{command}.py", *arguments)]
    process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
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


@pytest.fixture(scope="module")
def planned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A grasp file."""
    out = tmp_path_factory.mktemp("planned") / "box.grasp.json"
    process = started(ASSETS / "box" / "box.xml", "--candidates", 60, "--out", out)
    process.communicate(timeout=60)
    assert process.returncode == 0
    return out


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.parametrize("command", ["verify", "validate"])
def test_a_signal_ends_a_check_with_one_line_and_leaves_no_file(command: str, planned: Path, tmp_path: Path) -> None:
    out = tmp_path / "box.validation.json"
    wanted = ["--out", out] if command == "validate" else []
    for how, instant in ((signal.SIGINT, 0.0), (signal.SIGTERM, 0.7), (signal.SIGINT, 1.9), (signal.SIGTERM, 3.1)):
        process = started(planned, *wanted, command=command)
        time.sleep(instant)
        process.send_signal(how)
        _, err = process.communicate(timeout=60)
        assert process.returncode in ((130, 0) if instant else (130,)), err
        said = [line for line in err.splitlines() if not line.startswith("\N{HORIZONTAL ELLIPSIS}")]
        assert said == (["interrupted; nothing is written"] if process.returncode == 130 else [])
        assert list(tmp_path.iterdir()) == ([out] if command == "validate" and process.returncode == 0 else [])
        out.unlink(missing_ok=True)


@pytest.mark.parametrize("instant", ["planner.planning.plan_several", "planner.grasps.grasp_file.write_grasp"])
def test_a_signal_between_the_proof_and_the_file_does_not_lose_the_grasp(instant: str, tmp_path: Path) -> None:
    """After the search has returned, and before the file is begun."""
    module, function = instant.rsplit(".", 1)
    out = tmp_path / "a.grasp.json"
    program = f"""
import os, signal, sys, time
from planner.commands.start import plan
import {module} as module
original = module.{function}
def interrupted(*arguments):
    if {function!r} == "write_grasp":
        signal_self()
        return original(*arguments)
    found = original(*arguments)
    signal_self()
    return found
def signal_self():
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(0.3)
module.{function} = interrupted
sys.argv = ["grasp-plan", {str(ASSETS / "box" / "box.xml")!r}, "--candidates", "60", "--out", {str(out)!r}]
plan()
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=ROOT, check=False)
    assert done.returncode == 0, done.stderr
    assert "stopping" in done.stderr
    assert read_grasp(out).status == "optimal"


@pytest.mark.parametrize(("candidates", "fingers"), [(30_000, 3), (1000, 8)])
def test_the_time_limit_holds_for_the_whole_command(candidates: int, fingers: int, tmp_path: Path) -> None:
    limit = 0.5
    for _ in range(TRIES):
        late = lateness(candidates, fingers, limit, tmp_path / "a.grasp.json")
        if late < PROMISED:
            break
    assert late < PROMISED


def lateness(candidates: int, fingers: int, limit: float, out: Path) -> float:
    """How long after its limit a plan that cannot end within it ends, by its own clock [s]."""
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
    if out.exists():
        assert json.loads(out.read_text())["status"] == "time_limit"
    else:
        assert "no grasp found yet" in done.stderr
    return ended - began - limit
