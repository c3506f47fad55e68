"""The commands as users meet them: the main job, the exit codes, and every kind of bad input."""

import json
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from planner.grasps.document import FORMAT_VERSION
from tests.tools.commands import ASSETS, PRISM, ROOT, heavy_after, heavy_after_help, run, says

pytestmark = pytest.mark.slow


def plan_prism(out: Path, *arguments: object) -> int:
    return run(
        "grasp-plan", PRISM, "--friction", 0.3, "--task", "paper", "--candidates", "case3", "--out", out, *arguments
    )


def test_the_main_job_plans_verifies_and_validates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    grasp, validation = tmp_path / "prism.grasp.json", tmp_path / "prism.validation.json"
    assert plan_prism(grasp) == 0
    assert says(capsys.readouterr().out, r"rho 0\.669003 N")
    assert run("grasp-verify", grasp) == 0
    assert "FAIL" not in capsys.readouterr().out
    assert run("grasp-validate", grasp, "--out", validation) == 0
    assert says(capsys.readouterr().out, "64 of 64 wrenches held.* verdict +PASS")
    document = json.loads(validation.read_text())
    assert document["format"] == "rhograsp.validation"
    assert document["verdict"] == "pass"
    assert [control["behaved"] for control in document["controls"]] == [True] * 4
    assert document["controls"][0]["outcomes"][0]["held"] is False
    assert document["protocol"]["hold_factor"] == 1.02


def test_the_scripts_are_the_commands(tmp_path: Path) -> None:
    grasp = tmp_path / "box.grasp.json"
    for script, *arguments in (
        ("plan", ASSETS / "box" / "box.xml", "--candidates", "60", "--out", grasp, "--quiet"),
        ("verify", grasp),
        ("validate", grasp, "--out", tmp_path / "box.validation.json"),
    ):
        command = [sys.executable, ROOT / "scripts" / f"{script}.py", *arguments]
        done = subprocess.run(
            [str(part) for part in command], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("script", ["plan", "verify", "validate"])
def test_help_teaches_and_loads_nothing_heavy(script: str) -> None:
    heavy, printed = heavy_after_help(script, "mujoco", "cvxpy", "scipy", "trimesh", "dm_control")
    assert not heavy
    assert says(printed, "exit codes: 0 done and proven")


def test_what_a_command_does_not_need_it_does_not_load(tmp_path: Path) -> None:
    grasp = tmp_path / "prism.grasp.json"
    never = ("matplotlib", "glfw", "OpenGL", "PIL", "trimesh", "typeguard", "asyncio", "urllib.request")
    optimising, simulating = ("cvxpy", "scipy.optimize", "scipy.stats"), ("dm_control", "mujoco.batch")
    suspects = (*never, *optimising, *simulating, "numba")
    paper = ("--friction", 0.3, "--task", "paper", "--candidates", "case3")
    heavy, printed = heavy_after("plan", [PRISM, *paper, "--out", grasp], *suspects)
    assert heavy == ["numba"]
    assert says(printed, r"rho 0\.669003 N")
    heavy, _ = heavy_after("validate", [grasp, "--out", tmp_path / "x.validation.json"], *suspects)
    assert heavy == sorted(simulating)
    heavy, _ = heavy_after("inspect_object", [PRISM], *suspects)
    assert heavy == []
    heavy, _ = heavy_after("verify", [grasp], *suspects)
    assert heavy == sorted(optimising)
    heavy, _ = heavy_after("report", [grasp, "--out", tmp_path / "x.html"], "numba", *optimising, *simulating)
    assert heavy == []


def test_an_impossible_task_is_proven_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    grasp = tmp_path / "pair.grasp.json"
    assert plan_prism(grasp, "--fingers", 2) == 3
    assert says(capsys.readouterr().out, "infeasible proven: .* moment about the line")
    assert run("grasp-verify", grasp) == 0
    capsys.readouterr()
    assert run("grasp-validate", grasp) == 1
    assert says(capsys.readouterr().err, "holds no grasp")
    assert plan_prism(grasp, "--fingers", 1) == 3
    assert run("grasp-verify", grasp) == 0


def test_one_direction_proves_a_task_beyond_all_candidates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    top = tmp_path / "top.csv"
    top.write_text("x,y,z\n-0.01,-0.01,0.01\n0,-0.01,0.01\n-0.01,0,0.01\n-0.005,-0.005,0.01\n")
    grasp = tmp_path / "top.grasp.json"
    assert run("grasp-plan", PRISM, "--friction", 0.3, "--candidates", top, "--out", grasp) == 3
    assert says(capsys.readouterr().out, r"direction \(.*\): no candidate can push")
    assert run("grasp-verify", grasp) == 0


def test_at_a_time_limit_the_best_grasp_and_its_true_gap_are_written(tmp_path: Path) -> None:
    grasp = tmp_path / "hasty.grasp.json"
    assert plan_prism(grasp, "--fingers", 4, "--time-limit", 1.0, "--gap", 0) in (0, 4)
    document = json.loads(grasp.read_text())
    if document["status"] == "time_limit" and document["rho"] is not None:
        assert document["gap"] == pytest.approx(document["rho"] / document["lower_bound"] - 1)
    assert plan_prism(grasp, "--time-limit", 0) == 4
    assert json.loads(grasp.read_text())["status"] == "time_limit"


WORLD = "<mujoco><worldbody>{}</worldbody></mujoco>"
BOX = '<body name="a"><freejoint/><geom type="box" size=".01 .02 .03" {}/></body>'
BALL = '<body name="b" pos="1 0 0"><freejoint/><geom size=".01"/></body>'
MESH = (
    '<mujoco><asset><mesh name="m" {}/></asset><worldbody><body><freejoint/><geom type="mesh" mesh="m"/></body>'
    "</worldbody></mujoco>"
)


def write(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


def test_bad_objects_are_refused_with_a_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    flat = 'vertex="0 0 0 1 0 0 0 1 0 1 1 0"'
    nan = 'vertex="0 0 0 1 0 0 0 1 0 nan 0 1"'
    for name, text, message in (
        ("missing.xml", None, "missing.xml"),
        ("broken.xml", "<mujoco><worldbody>", "broken.xml"),
        ("no_mesh.xml", MESH.format('file="nowhere.stl"'), "nowhere.stl"),
        ("flat.xml", MESH.format(flat), "flat|volume|coplanar|degenerate|qhull"),
        ("nan.xml", MESH.format(nan), "nan"),
        ("plane.xml", WORLD.format('<geom type="plane" size="1 1 1"/>'), "body|collide"),
        ("ghost.xml", WORLD.format(BOX.format('contype="0" conaffinity="0"')), "collide"),
        ("two.xml", WORLD.format(BOX.format("") + BALL), "--body"),
    ):
        path = tmp_path / name if text is None else write(tmp_path / name, text)
        assert run("grasp-plan", path, "--out", tmp_path / "x.grasp.json") == 1, name
        assert says(capsys.readouterr().err, rf"(^|\. )error: (?i:.*({message}))"), name  # after MuJoCo's warnings
    assert run("grasp-plan", tmp_path / "two.xml", "--body", "c", "--out", tmp_path / "x.grasp.json") == 1
    assert says(capsys.readouterr().err, "'?c'?.*'?a'?.*'?b'?")
    assert not (tmp_path / "x.grasp.json").exists()


def test_bad_options_are_refused_with_a_reason(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    empty = write(tmp_path / "empty.toml", '[set]\nkind = "polytope"\nwrenches = []\n')
    not_finite = write(tmp_path / "nan.toml", '[set]\nkind = "box"\nforce = [nan, 1, 1]\nmoment = [0, 0, 0]\n')
    nothing = write(tmp_path / "zero.toml", '[set]\nkind = "single"\nwrench = [0, 0, 0, 0, 0, 0]\n')
    for arguments, message in (
        (("--friction", 0), "friction.*0"),
        (("--friction", -0.3), "friction.*-0.3"),
        (("--friction", "nan"), "friction.*nan"),
        (("--fingers", 4, "--candidates", "3"), "4 fingers but only 3"),
        (("--fingers", -1), "-1 fingers"),
        (("--fingers", 0), "0 fingers"),
        (("--fingers", 9), "9 fingers"),
        (("--candidates", "0"), "0"),
        (("--candidates", "nowhere.csv"), "nowhere.csv"),
        (("--candidates", "grid:-1"), "-1"),
        (("--task", "nowhere.toml"), "nowhere.toml"),
        (("--task", empty), "empty|wrenches"),
        (("--task", not_finite), "nan|finite"),
        (("--task", nothing), "zero"),
        (("--gap", -1), "gap"),
        (("--gap", "nan"), "gap"),
        (("--time-limit", -1), "time"),
        (("--out", tmp_path / "no" / "where.grasp.json"), "cannot write"),
        (("--out", tmp_path), "cannot write"),
    ):
        out = () if "--out" in arguments else ("--out", tmp_path / "x.grasp.json")
        assert run("grasp-plan", PRISM, *arguments, *out) == 1, arguments
        assert says(capsys.readouterr().err, f"^error: .*({message})"), arguments
    assert list(tmp_path.glob("*.json")) == []


def test_a_wrong_command_line_is_a_usage_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("grasp-plan") == 2
    assert run("grasp-plan", PRISM, "--fingers", "three") == 2
    assert run("grasp-validate", "--speed", 3) == 2
    capsys.readouterr()


def test_a_changed_or_moved_object_is_noticed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(ASSETS / "ellipsoid", tmp_path / "ellipsoid")
    copy, grasp = tmp_path / "ellipsoid" / "ellipsoid.xml", tmp_path / "e.grasp.json"
    assert run("grasp-plan", copy, "--candidates", "60", "--out", grasp, "-q") == 0
    mesh = copy.with_name("ellipsoid.obj")
    mesh.write_text(mesh.read_text() + "# touched\n")
    assert run("grasp-validate", grasp, "--out", tmp_path / "v.json") == 1
    assert says(capsys.readouterr().err, "has changed since the grasp was planned")
    shutil.rmtree(copy.parent)
    assert run("grasp-validate", grasp, "--out", tmp_path / "v.json") == 1
    assert says(capsys.readouterr().err, "--object")
    original = ASSETS / "ellipsoid" / "ellipsoid.xml"
    assert run("grasp-validate", grasp, "--object", original, "--out", tmp_path / "v.json", "-q") == 0


def test_an_edited_truncated_or_newer_grasp_file_is_refused(
    golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = golden_file.read_text()
    for content, message in (
        (text[: len(text) // 2], "truncated"),
        (text.replace(f'"format_version": {FORMAT_VERSION}', '"format_version": 99'), "format version 99"),
        (text.replace('"rho": 0.669', '"rho": 0.649'), "rho does not agree"),
        ("{}", "not a grasp file"),
    ):
        golden_file.write_text(content)
        for command in ("grasp-verify", "grasp-validate"):
            assert run(command, golden_file) == 1
            assert says(capsys.readouterr().err, f"^error: .*{message}")
    assert run("grasp-validate", tmp_path / "nowhere.grasp.json") == 1
    assert says(capsys.readouterr().err, "nowhere.grasp.json")


def test_the_proof_of_the_golden_case_takes_seconds_not_minutes(tmp_path: Path) -> None:
    """No benchmark: a hundred times the measured time, against a search that has lost its pruning."""
    began = time.perf_counter()
    assert plan_prism(tmp_path / "x.grasp.json", "-q") == 0
    assert time.perf_counter() - began < 100


def test_ctrl_c_writes_the_best_grasp_with_its_open_gap(tmp_path: Path) -> None:
    grasp = tmp_path / "stopped.grasp.json"
    command = [sys.executable, ROOT / "scripts" / "plan.py", ASSETS / "mug" / "mug.xml", "--fingers", 5]
    command += ["--candidates", 800, "--out", grasp]
    with subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if line.split()[:2] == ["0", "1"]:  # the first line of the log: a first grasp is known
                process.send_signal(signal.SIGINT)
                break
        process.stdout.read()
        assert process.wait(60) == 4
    document = json.loads(grasp.read_text())
    assert document["status"] == "interrupted"
    assert document["rho"] > 0
    assert run("grasp-verify", grasp) == 0


def test_the_other_modes_test_measure_and_label_something_else(
    golden_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("grasp-validate", golden_file, "--mode", "squeeze") == 0
    assert says(capsys.readouterr().out, r"predicted 0\.869.* N, measured .* not rho: .* CONFIRMED \(rhograsp.squeeze")
    squeeze = json.loads((tmp_path / "golden.squeeze.json").read_text())
    assert squeeze["format"] == "rhograsp.squeeze"
    for mode in ("dexgraspbench", "graspdatagen"):
        code = run("grasp-validate", golden_file, "--mode", mode, "--squeeze", 20)
        assert code in (0, 5)
        assert says(capsys.readouterr().out, rf"{'PASS' if code == 0 else 'FAIL'} \(.*\(fingertips\)")
        assert json.loads((tmp_path / "golden.bench.json").read_text())["format"] == "rhograsp.bench"
    assert run("grasp-validate", golden_file, "--mode", "graspdatagen", "--squeeze", -1) == 1
    assert says(capsys.readouterr().err, "squeeze is -1")


def test_a_reader_that_has_seen_enough_meets_no_traceback(tmp_path: Path) -> None:
    command = (
        f"{sys.executable} {ROOT / 'scripts' / 'plan.py'} {PRISM} --candidates 20 --out {tmp_path / 'a.json'} | head -1"
    )
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout.count("\n") == 1
    assert "Traceback" not in done.stderr
