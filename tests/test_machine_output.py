"""Programs that run the commands: one JSON document, a log to follow, no control characters, and silence on request."""

import json
import math
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from tests.tools.commands import ASSETS, PRISM, ROOT, run
from tests.tools.terminals import screen

pytestmark = pytest.mark.slow

CASE_3 = ("--friction", 0.3, "--task", "paper", "--candidates", "case3")
PLAN = [sys.executable, str(ROOT / "scripts" / "plan.py")]
LONG = [*PLAN, str(ASSETS / "mug" / "mug.xml"), "--fingers", "5", "--candidates", "800"]
"""A search that outlasts every test."""


def lines_of(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def wait_for_lines(path: Path, process: subprocess.Popen[Any], count: int) -> None:
    deadline = time.monotonic() + 60
    while not (path.exists() and path.read_bytes().count(b"\n") >= count):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.02)


def test_a_plan_in_json_is_what_the_file_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    grasp, log = tmp_path / "prism.grasp.json", tmp_path / "log.jsonl"
    assert run("grasp-plan", PRISM, *CASE_3, "--out", grasp, "--json", "--log-json", log) == 0
    captured = capsys.readouterr()
    printed, written = json.loads(captured.out), json.loads(grasp.read_text())
    for key in ("status", "rho", "lower_bound", "gap", "critical_wrench", "contacts"):
        assert printed[key] == written[key], key
    assert printed["seconds"] == written["search"]["seconds"]
    assert 0 < printed["grip"] <= printed["rho"]
    assert Path(printed["file"]) == grasp
    assert "rho         0.669003 N" in captured.err
    assert captured.err.replace("\n", "").isprintable()
    last = lines_of(log)[-1]
    assert last["status"] == "optimal" and last["incumbent"] == written["rho"]


def test_what_does_not_exist_is_null_and_an_error_leaves_standard_output_empty(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    grasp = tmp_path / "pair.grasp.json"
    assert run("grasp-plan", PRISM, *CASE_3, "--fingers", 2, "--out", grasp, "--json", "-q") == 3
    captured = capsys.readouterr()
    printed = json.loads(captured.out)
    assert (printed["status"], printed["contacts"]) == ("infeasible", [])
    assert [printed[key] for key in ("rho", "gap", "grip")] == [None, None, None]
    assert captured.err == ""
    assert run("grasp-plan", tmp_path / "nowhere.xml", "--json", "-q") == 1
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.startswith("error: ")
    assert run("grasp-plan", PRISM, "--out", grasp, "--log-json", tmp_path / "no" / "log.jsonl") == 1
    assert "cannot write" in capsys.readouterr().err


def test_verifying_and_validating_in_json_says_what_came_out(
    golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("grasp-verify", golden_file, "--json") == 0
    captured = capsys.readouterr()
    printed = json.loads(captured.out)
    assert printed["true"] is True and all(check["result"] == "holds" for check in printed["checks"])
    assert captured.err.count("ok  ") == len(printed["checks"]) >= 6
    out = tmp_path / "golden.validation.json"
    assert run("grasp-validate", golden_file, "--out", out, "--json", "-q") == 0
    captured = capsys.readouterr()
    printed, written = json.loads(captured.out), json.loads(out.read_text())
    for key in ("verdict", "reasons", "rho", "critical_wrench"):
        assert printed[key] == written[key], key
    assert printed["held"] == sum(record["held"] for record in written["vertices"]) == printed["wrenches"]
    assert captured.err == "" and Path(printed["file"]) == out


def test_a_refuted_file_is_said_to_be_so(golden_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    document = json.loads(golden_file.read_text())
    weakest = min(document["forces"][0], key=lambda force: math.hypot(*force))
    weakest[:] = [0.99 * component for component in weakest]
    golden_file.write_text(json.dumps(document))
    assert run("grasp-verify", golden_file, "--json", "-q") == 5
    printed = json.loads(capsys.readouterr().out)
    assert printed["true"] is False
    assert [check["claim"] for check in printed["checks"] if check["result"] == "fails"] == [
        "the forces balance every wrench"
    ]


def test_quiet_is_silent(golden_file: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run("grasp-plan", ASSETS / "box" / "box.xml", "--candidates", 60, "--out", tmp_path / "b.json", "-q") == 0
    assert run("grasp-verify", golden_file, "-q") == 0
    assert run("grasp-validate", golden_file, "--out", tmp_path / "v.json", "-q") == 0
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("how", "code"), [(signal.SIGINT, 4), (signal.SIGKILL, -signal.SIGKILL)])
def test_the_json_log_can_be_followed_and_outlives_an_interruption(
    how: signal.Signals, code: int, tmp_path: Path
) -> None:
    log = tmp_path / "log.jsonl"
    command = [*LONG, "--out", str(tmp_path / "mug.grasp.json"), "--log-json", str(log), "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        wait_for_lines(log, process, 2)
        process.send_signal(how)
        out, err = process.communicate(timeout=60)
        assert process.returncode == code
    lines = lines_of(log)
    times, bounds = ([line[key] for line in lines] for key in ("seconds", "lower_bound"))
    assert times == sorted(times) and bounds == sorted(bounds)
    assert err.replace("\n", "").isprintable()
    if how is signal.SIGINT:
        assert lines[-1]["status"] == json.loads(out)["status"] == "interrupted"
        assert "stopping; press Ctrl-C again" in err


def test_on_a_terminal_the_search_is_watched_on_one_line(tmp_path: Path) -> None:
    written = on_a_terminal([*LONG, "--time-limit", "2", "--out", str(tmp_path / "mug.grasp.json")], code=4)
    assert "\rloading MuJoCo" in written
    seen = screen(written)
    assert not any("loading" in line for line in seen)
    head = next(number for number, line in enumerate(seen) if line.split()[:2] == ["Nodes", "Open"])
    log = seen[head + 1 : seen.index("", head)]
    assert all(len(line.split()) == 8 for line in log)
    drawn = [part for part in written.split("\r") if part.startswith("first grasps") or part.rstrip().endswith("s")]
    assert len(drawn) > 5 + len(log)  # again and again between the lines that stay


def on_a_terminal(command: list[str], code: int) -> str:
    """What a command writes to a terminal that is all its standard streams."""
    outside, inside = pty.openpty()
    environment = os.environ | {"TERM": "xterm"}
    with subprocess.Popen(command, stdin=inside, stdout=inside, stderr=inside, env=environment) as process:
        os.close(inside)
        received = b""
        while True:
            try:
                received += os.read(outside, 65536)
            except OSError:  # how Linux says that the other side has closed
                break
        assert process.wait(60) == code, received
    os.close(outside)
    return received.decode().replace("\r\n", "\n")
