"""No MJCF file keeps the compiler busy, waiting, or eating memory without end."""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import mujoco
import pytest

from planner.errors import MasslessError, ObjectError
from planner.objects.mjcf.bounded_compile import MOST_SECONDS, compile_bounded
from planner.objects.mjcf.compile_effort import MOST_ELEMENTS, require_moderate
from planner.objects.mjcf.compiled import compile_mjcf
from planner.objects.mjcf.reader import read_object
from tests.tools.commands import ROOT, run
from tests.tools.shared import shared

BALL = '<geom size=".1"/>'
LUMP = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'


def written(folder: Path, body: str, assets: str = "") -> Path:
    """A file with one body."""
    path = folder / "o.xml"
    path.write_text(
        f"<mujoco><asset>{assets}</asset><worldbody><body name='o'><freejoint/>{LUMP}{body}</body></worldbody></mujoco>"
    )
    return path


def copies(count: int, content: str) -> str:
    return f'<replicate count="{count}" offset="1 0 0">{content}</replicate>'


@pytest.mark.parametrize(
    "body",
    [
        copies(100_000, BALL),
        copies(100, copies(100, copies(100, BALL))),
        copies(1_000_000_000, f"<body>{BALL}</body>"),
        '<flexcomp name="f" type="grid" count="200 200 200" spacing=".1 .1 .1" dim="3"/>',
        BALL * (MOST_ELEMENTS + 1),
    ],
    ids=["replicate", "nested", "bodies", "flexcomp", "plain"],
)
def test_too_many_elements_are_refused_at_once(body: str, tmp_path: Path) -> None:
    path, began = written(tmp_path, body), time.monotonic()
    with pytest.raises(ObjectError, match="more than 20,000 elements"):
        compile_mjcf(path)
    assert time.monotonic() - began < 5


def test_included_elements_count_as_often_as_they_are_copied(tmp_path: Path) -> None:
    (tmp_path / "more.xml").write_text(f"<mujoco>{BALL * 101}</mujoco>")
    path = written(tmp_path, copies(200, '<include file="more.xml"/>'))
    with pytest.raises(ObjectError, match="200 of them copies of one <geom>"):
        require_moderate(path)
    require_moderate(written(tmp_path, copies(190, '<include file="more.xml"/>')))


def test_many_elements_are_no_harm(tmp_path: Path) -> None:
    model, _ = compile_mjcf(written(tmp_path, copies(50, copies(20, BALL))))
    assert model.ngeom == 1000


@pytest.mark.parametrize(
    "text", ["", "<mujoco", "\0\1", "<mujoco><worldbody><replicate count='x'/></worldbody></mujoco>"]
)
def test_what_is_no_mjcf_is_for_mujoco_to_explain(text: str, tmp_path: Path) -> None:
    path = tmp_path / "o.xml"
    path.write_text(text)
    with pytest.raises(ObjectError, match="MuJoCo cannot compile"):
        compile_mjcf(path)


def a_pipe(path: Path) -> str:
    os.mkfifo(path)
    return "a pipe"


def a_device(path: Path) -> str:
    path.symlink_to("/dev/zero")
    return "a device"


def a_socket(path: Path) -> str:
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(path))
    return "a socket"


def a_folder(path: Path) -> str:
    path.mkdir()
    return "a folder"


@pytest.mark.parametrize("make", [a_pipe, a_device, a_socket, a_folder])
@pytest.mark.parametrize(
    ("name", "body", "asset"),
    [
        ("m.obj", '<geom type="mesh" mesh="m"/>', '<mesh name="m" file="m.obj"/>'),
        ("t.png", BALL, '<texture name="t" type="2d" file="t.png"/>'),
        ("h.png", BALL, '<hfield name="h" size="1 1 1 1" file="h.png"/>'),
        ("i.xml", f'{BALL}<include file="i.xml"/>', ""),
    ],
)
def test_a_named_file_that_is_no_regular_one_is_never_opened(
    make: Callable[[Path], str], name: str, body: str, asset: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, kind = written(tmp_path, body, asset), make(tmp_path / name)
    assert run("grasp-inspect", path) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: ") and error.count("\n") == 1 and kind in error and name in error


@pytest.mark.parametrize("make", [a_pipe, a_device, a_socket, a_folder])
def test_an_object_that_is_no_regular_file_is_never_opened(
    make: Callable[[Path], str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    make(tmp_path / "o.xml")
    make(tmp_path / "o.toml")
    for name in ("o.xml", "o.toml"):
        assert run("grasp-inspect", tmp_path / name) == 1
        error = capsys.readouterr().err
        assert error.startswith("error: ") and error.count("\n") == 1 and name in error


def test_a_compiler_that_does_not_end_is_given_up_on(tmp_path: Path) -> None:
    torus = '<mesh name="m" builtin="supertorus" params="3000 .3 1 1"/>'
    path, began = written(tmp_path, '<geom type="mesh" mesh="m"/>', torus), time.monotonic()
    with pytest.raises(ObjectError, match=r"more than 0\.5 s"):
        compile_bounded(path, lambda: mujoco.MjModel.from_xml_path(str(path)), seconds=0.5)
    assert time.monotonic() - began < 10
    assert MOST_SECONDS <= 60


@pytest.mark.slow
def test_a_compiler_that_wants_all_memory_is_refused_it(tmp_path: Path) -> None:
    path = written(tmp_path, BALL, '<hfield name="h" nrow="60000" ncol="60000" size="1 1 1 1"/>')
    with pytest.raises(ObjectError, match="cannot compile"):
        compile_mjcf(path)
    with pytest.raises(ObjectError, match=r"within 0.25 GiB of memory"):
        compile_bounded(path, lambda: bytearray(2**29), most_bytes=2**28)
    assert len(bytearray(2**29)) == 2**29  # the limit was for the compiler only


def test_a_texture_that_wants_all_memory_is_left_out(tmp_path: Path) -> None:
    large = '<texture name="t" type="2d" builtin="checker" width="60000" height="60000"/>'
    model, (complaint,) = compile_mjcf(written(tmp_path, BALL, large))
    assert model.ngeom == 1
    assert "memory" in complaint


def test_a_compiler_that_crashes_leaves_an_error(tmp_path: Path) -> None:
    with pytest.raises(ObjectError, match="SIGSEGV"):
        compile_bounded(written(tmp_path, BALL), lambda: os.kill(os.getpid(), signal.SIGSEGV))


def test_a_file_is_rehearsed_once_and_again_when_it_has_changed(tmp_path: Path) -> None:
    path, runs = written(tmp_path, BALL), tmp_path / "runs"

    def compiled() -> int:
        with runs.open("a") as stream:
            stream.write(f"{os.getpid()}\n")
        return os.getpid()

    assert compile_bounded(path, compiled) == compile_bounded(path, compiled) == os.getpid()
    assert [int(line) == os.getpid() for line in runs.read_text().split()] == [False, True, True]
    path.write_text(path.read_text() + " ")
    compile_bounded(path, compiled)
    assert len(runs.read_text().split()) == 5


def test_an_interrupted_rehearsal_leaves_no_process(tmp_path: Path) -> None:
    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(KeyboardInterrupt):
            compile_bounded(written(tmp_path, BALL), lambda: time.sleep(60))
    finally:
        signal.signal(signal.SIGALRM, before)
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


def test_a_compilers_complaint_is_what_it_was(tmp_path: Path) -> None:
    path = written(tmp_path, '<geom type="mesh" mesh="none"/>')
    with pytest.raises(ObjectError, match=r"MuJoCo cannot compile '.*o.xml': Error: mesh 'none' not found"):
        read_object(path)


def test_the_file_that_once_hung_it_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("grasp-inspect", shared("faults", "mjcf_hang", "o.xml")) == 1
    assert "100,000 of them copies of one <geom>" in capsys.readouterr().err


def test_the_copy_tells_the_kind_of_its_refusal_and_every_letter(tmp_path: Path) -> None:
    path = tmp_path / "ö\r\n.xml"
    path.write_text("<mujoco><worldbody><body><freejoint/><geom size='.1' mass='0'/></body></worldbody></mujoco>")
    with pytest.raises(MasslessError) as refused:
        compile_mjcf(path)
    assert str(refused.value).startswith(f"MuJoCo cannot compile '{path}': ")
    assert str(refused.value).endswith("give the object's with --mass")


def test_where_processes_are_not_copied_the_compiler_runs_in_place(tmp_path: Path) -> None:
    path = written(tmp_path, BALL)
    script = f"""
import os, sys
del os.fork
sys.modules["resource"] = sys.modules["fcntl"] = None
from pathlib import Path
from planner.files.atomic_write import write_atomically
from planner.objects.mjcf.compiled import compile_mjcf
path = Path({str(path)!r})
print(compile_mjcf(path)[0].ngeom)
write_atomically(path.with_name("out"), b"whole")
"""
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("1\n", "")
    assert (tmp_path / "out").read_bytes() == b"whole"
    assert sorted(each.name for each in tmp_path.iterdir()) == ["o.xml", "out"]
