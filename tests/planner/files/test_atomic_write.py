"""A file is there as a whole, whoever is killed while writing it and whoever else writes it."""

import errno
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from planner.errors import OutputError
from planner.files.atomic_write import BEGIN, END, require_writable, write_atomically
from tests.tools.commands import ROOT

pytestmark = pytest.mark.slow

WRITE = """
import os, random, sys, time
from pathlib import Path
from planner.files.atomic_write import BEGIN, write_atomically

def write_forever(path, letters):
    while True:
        for letter in letters:
            write_atomically(path, 200_000 * letter.encode())

path, letters = Path(sys.argv[1]), sys.argv[2]
"""

KILL_300 = f"""{WRITE}
instant, most = random.Random(0), 0
for _ in range(300):
    child = os.fork()
    if child == 0:
        write_forever(path, letters)
    time.sleep(instant.uniform(0, 0.02))
    os.kill(child, 9)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == -9
    most = max(most, sum(name.startswith(BEGIN) for name in os.listdir(path.parent)))
print(most)
"""


@contextmanager
def running(script: str, path: Path, letters: str) -> "Iterator[subprocess.Popen[str]]":
    command = [sys.executable, "-c", script, str(path), letters]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            yield process
        finally:
            process.kill()


def require_whole(path: Path, letters: str) -> str:
    """The letter that a file consists of."""
    content = path.read_bytes().decode()
    assert content in {200_000 * letter for letter in letters}
    return content[0]


def test_a_reader_finds_a_whole_file_whenever_one_of_300_writers_is_killed(tmp_path: Path) -> None:
    path = tmp_path / "x.grasp.json"
    path.write_text(200_000 * "a")
    seen = set()
    with running(KILL_300, path, "abc") as process:
        while process.poll() is None:
            seen.add(require_whole(path, "abc"))
        assert process.stdout is not None and process.stderr is not None
        most, complaints = process.stdout.read(), process.stderr.read()
    assert seen == set("abc") and complaints == ""
    assert int(most) == 1  # some were killed while they wrote; never did a pile grow
    write_atomically(path, b"done")
    assert [(file.name, file.read_bytes()) for file in tmp_path.iterdir()] == [("x.grasp.json", b"done")]


def test_two_writers_at_once_do_not_disturb_each_other_or_a_reader(tmp_path: Path) -> None:
    path, seen = tmp_path / "x.grasp.json", set()
    path.write_text(200_000 * "a")
    script = f"{WRITE}write_forever(path, letters)"
    with running(script, path, "ab") as one, running(script, path, "cd") as other:
        for _ in range(100_000):
            seen.add(require_whole(path, "abcd"))
            assert one.poll() is None and other.poll() is None
            if seen == set("abcd"):
                break
        for _ in range(300):
            require_whole(path, "abcd")
        assert one.poll() is None and other.poll() is None
    write_atomically(path, b"done")
    assert [file.name for file in tmp_path.iterdir()] == ["x.grasp.json"]


def test_files_that_only_look_like_temporary_ones_of_the_living_stay(tmp_path: Path) -> None:
    other = tmp_path / f"{BEGIN}notes.txt"
    other.write_text("mine")
    (tmp_path / f"{BEGIN}link{END}").symlink_to(other)
    write_atomically(tmp_path / "x", b"")
    assert other.read_text() == "mine"


def a_folder(path: Path) -> None:
    path.mkdir()


def a_pipe(path: Path) -> None:
    os.mkfifo(path)


def a_device(path: Path) -> None:
    path.symlink_to("/dev/full")


@pytest.mark.parametrize("make", [a_folder, a_pipe, a_device])
@pytest.mark.parametrize("write", [require_writable, lambda path: write_atomically(path, b"")])
def test_nothing_but_a_file_is_replaced(
    make: Callable[[Path], None], write: Callable[[Path], None], tmp_path: Path
) -> None:
    make(tmp_path / "x")
    before = (tmp_path / "x").lstat().st_mode
    with pytest.raises(OutputError, match=r"it is a (folder|pipe|device); name a file"):
        write(tmp_path / "x")
    assert (tmp_path / "x").lstat().st_mode == before


@pytest.mark.parametrize("name", ["n" * 300, "nul\0", "missing/x", "file/x"])
@pytest.mark.parametrize("write", [require_writable, lambda path: write_atomically(path, b"")])
def test_a_name_that_no_file_can_have_is_refused(name: str, write: Callable[[Path], None], tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"cannot write .*; choose"):
        write(tmp_path / name)


def test_the_longest_name_can_be_written(tmp_path: Path) -> None:
    write_atomically(tmp_path / ("n" * 255), b"all")
    assert (tmp_path / ("n" * 255)).read_bytes() == b"all"


@pytest.mark.parametrize("failing", ["os.fsync", "os.chmod", "tempfile.mkstemp"])
def test_a_full_device_leaves_the_old_file_and_nothing_else(
    failing: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    (tmp_path / "x").write_text("old")
    monkeypatch.setattr(failing, full)
    with pytest.raises(OutputError, match="No space left on device"):
        write_atomically(tmp_path / "x", b"new")
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("x", "old")]
