"""Whatever a user names as input or output, a command ends with one line and exit code 1."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.tools.commands import MAINS, PRISM, ROOT, run

pytestmark = pytest.mark.slow

LONG = "n" * 300
FULL = Path("/dev/full")


def a_pipe(path: Path) -> None:
    os.mkfifo(path)


def an_endless_device(path: Path) -> None:
    path.symlink_to("/dev/zero")


def a_folder(path: Path) -> None:
    path.mkdir()


def nothing(_: Path) -> None:
    pass


def holding(content: bytes) -> Callable[[Path], None]:
    def make(path: Path) -> None:
        path.write_bytes(content)

    return make


BROKEN = {
    "pipe": a_pipe,
    "device": an_endless_device,
    "folder": a_folder,
    "nothing": nothing,
    "empty": holding(b""),
    "deep": holding(b"[" * 100_000),
    "deep object": holding(b'{"format":' * 100_000),
    "deep rest": holding(b'{"format": "rhograsp.grasp", "format_version": 2, "x": ' + b"[" * 100_000),
    "deep old": holding(b'{"format": "rhograsp.grasp", "format_version": 1, "certificate": ' + b"[" * 100_000),
    "deep toml": holding(b"kind = " + b"[" * 100_000),
    "huge number": holding(b'{"format": "rhograsp.grasp", "format_version": 1' + b"0" * 5000 + b"}"),
    "huge toml number": holding(b"spacing = 1" + b"0" * 4000 + b"\nkind = 1"),
    "nan": holding(b'{"format": NaN, "format_version": 2}'),
    "utf-8": holding(b'{"format": "\xff", "format_version": 2}'),
    "surrogate": holding(b'{"format": "\\ud800", "format_version": 2}'),
    "old": holding(b'{"format": "rhograsp.grasp", "format_version": 1}'),
    "old without a name": holding(
        b'{"format": "rhograsp.grasp", "format_version": 1, "certificate": {"file": "..", "sha256": "", "cuts": 0}}'
    ),
    "old with a name": holding(
        b'{"format": "rhograsp.grasp", "format_version": 1, '
        b'"certificate": {"file": "\\u0000", "sha256": "", "cuts": 0}}'
    ),
    "bytes": holding(bytes(range(256))),
}

READERS: dict[str, tuple[str, tuple[object, ...]]] = {
    "verify": ("grasp-verify", ("INPUT",)),
    "validate": ("grasp-validate", ("INPUT",)),
    "report": ("grasp-report", ("INPUT",)),
    "report validation": ("grasp-report", ("GRASP", "--validation", "INPUT")),
    "convert": ("grasp-convert", ("INPUT", "--out", "x.glb")),
    "convert hand": ("grasp-convert", ("INPUT.npy", "--out", "x.isaac.yaml")),
    "validate object": ("grasp-validate", ("GRASP", "--object", "INPUT")),
    "inspect": ("grasp-inspect", ("INPUT.xml",)),
    "inspect planar": ("grasp-inspect", ("INPUT.toml",)),
    "plan": ("grasp-plan", ("INPUT.xml",)),
    "task": ("grasp-plan", (PRISM, "--task", "INPUT")),
    "limits": ("grasp-plan", (PRISM, "--limits", "INPUT")),
    "candidates": ("grasp-plan", (PRISM, "--candidates", "INPUT")),
}


@pytest.mark.parametrize("reader", READERS)
def test_an_input_that_cannot_be_read_ends_in_one_line(
    reader: str, golden_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    command, arguments = READERS[reader]
    for name, make in BROKEN.items():
        if (reader, name) == ("limits", "empty"):
            continue  # which limits nothing
        folder = tmp_path / name
        folder.mkdir()
        places = {word: folder / word for word in ("INPUT", "INPUT.xml", "INPUT.toml", "INPUT.npy")}
        for place in places.values():
            make(place)
        code = run(command, *(places.get(str(word), golden_file if word == "GRASP" else word) for word in arguments))
        error = capsys.readouterr().err
        assert (code, error[:7]) == (1, "error: ") and "Traceback" not in error, (name, error)
        assert len(error) < 1500 and sum(line.startswith("error: ") for line in error.splitlines()) == 1, (name, error)


@pytest.mark.parametrize("reader", READERS)
def test_a_name_that_is_too_long_ends_in_one_line(
    reader: str, golden_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    command, arguments = READERS[reader]
    words = (golden_file if word == "GRASP" else str(word).replace("INPUT", LONG) for word in arguments)
    assert run(command, *words) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: ") and error.count("\n") == 1


WRITERS: dict[str, tuple[str, tuple[object, ...]]] = {
    "plan": ("plan", (PRISM,)),
    "validate": ("validate", ("GRASP",)),
    "report": ("report", ("GRASP",)),
    "convert": ("convert", ("GRASP",)),
    "inspect": ("inspect", (PRISM,)),
}


@pytest.mark.parametrize("writer", WRITERS)
@pytest.mark.parametrize("name", [f"{LONG}.glb", "missing/x.glb", "folder.glb", "device.glb"])
def test_an_output_that_cannot_be_written_ends_in_one_line(
    writer: str, name: str, golden_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "folder.glb").mkdir()
    (tmp_path / "device.glb").symlink_to(FULL)
    command, arguments = WRITERS[writer]
    words = (golden_file if word == "GRASP" else word for word in arguments)
    assert run(f"grasp-{command}", *words, "--out", tmp_path / name) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: cannot write ") and error.count("\n") == 1


@pytest.mark.skipif(not FULL.exists(), reason="this system has no /dev/full")
@pytest.mark.parametrize(
    "command",
    [
        ("verify", "GRASP"),
        ("verify", "GRASP", "--json", "--quiet"),
        ("inspect", PRISM),
        ("convert", "GRASP", "--out", "x.isaac.yaml"),
        ("plan", "--help"),
    ],
    ids=lambda command: command[0],
)
def test_a_full_device_as_standard_output_ends_in_one_line(
    command: tuple[object, ...], golden_file: Path, tmp_path: Path
) -> None:
    name, *words = (str(golden_file) if word == "GRASP" else str(word) for word in command)
    main = f"import sys; from {MAINS[f'grasp-{name}'].__module__} import main; sys.argv[0] = 'x'; main()"
    with FULL.open("w") as full:
        done = subprocess.run(
            [sys.executable, "-c", main, *words],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=tmp_path,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            check=False,
        )
    errors = [line for line in done.stderr.splitlines() if not line.startswith("…")]  # which is the progress
    assert (done.returncode, errors) == (1, ["error: standard output: No space left on device"])


@pytest.mark.skipif(not FULL.exists(), reason="this system has no /dev/full")
@pytest.mark.parametrize("log", [FULL, Path("/"), Path(LONG)])
def test_a_log_that_cannot_be_written_ends_in_one_line(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "x.grasp.json"
    assert run("grasp-plan", PRISM, "--candidates", "30", "--out", out, "--log-json", log) == 1
    error = capsys.readouterr().err
    assert error.startswith("error: cannot write ") and error.count("\n") == 1
