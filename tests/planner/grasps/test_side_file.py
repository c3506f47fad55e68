"""Grasp files of version 1 are still read, and their side files believed in nothing."""

import hashlib
import io
import json
import os
import random
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.errors import GraspFileError
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import read_grasp
from planner.grasps.side_file import MOST_BYTES
from tests.strategies.side_files import archived, arrays_of, write_with_side_file
from tests.tools.commands import run
from tests.tools.shared import shared

ENDLESS = Path("/dev/zero")


def test_a_grasp_with_a_side_file_is_read(golden_grasp: Grasp, tmp_path: Path) -> None:
    arrays = arrays_of(golden_grasp)
    arrays["normals"] = np.asfortranarray(arrays["normals"])  # which NumPy notes in the header
    content = io.BytesIO()
    np.savez_compressed(content, allow_pickle=False, **arrays)
    write_with_side_file(tmp_path / "old.grasp.json", golden_grasp, content.getvalue())
    grasp = read_grasp(tmp_path / "old.grasp.json")
    for name, array in arrays_of(grasp).items():
        np.testing.assert_array_equal(array, arrays[name])
    assert (grasp.rho, grasp.search) == (golden_grasp.rho, golden_grasp.search)


def refused(path: Path, capsys: pytest.CaptureFixture[str], match: str = "") -> None:
    """The commands that read grasp files say one line and leave with 1."""
    assert run("grasp-verify", path) == 1
    line = capsys.readouterr().err
    assert line.startswith("error: ") and line.count("\n") == 1 and match in line


def complex_numbers(arrays: dict[str, Any]) -> bytes:
    return archived(arrays | {"cuts": arrays["cuts"].astype(complex)})


def words(arrays: dict[str, Any]) -> bytes:
    return archived(arrays | {"positions": arrays["positions"].astype("U20")})


def whole_numbers(arrays: dict[str, Any]) -> bytes:
    return archived(arrays | {"friction": np.ones(len(arrays["friction"]), dtype=np.int64)})


def objects(arrays: dict[str, Any]) -> bytes:
    return archived(arrays | {"friction": arrays["friction"].astype(object)}, pickled=True)


def records(arrays: dict[str, Any]) -> bytes:
    return archived(arrays | {"friction": np.zeros(3, dtype=[("a", float), ("b", float)])})


def too_few(arrays: dict[str, Any]) -> bytes:
    return archived({name: array for name, array in arrays.items() if name != "cuts"})


def other_cuts(arrays: dict[str, Any]) -> bytes:
    return archived(arrays | {"cuts": arrays["cuts"][1:]})


def unpacks_to_much(arrays: dict[str, Any]) -> bytes:
    """Of zeros: a thousandth of what it unpacks to."""
    return archived(arrays | {"cuts": np.zeros((MOST_BYTES // 8, 1))})


def lying_sizes(arrays: dict[str, Any]) -> bytes:
    """The archive says that its arrays are small."""
    content = bytearray(unpacks_to_much(arrays))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        size = archive.getinfo("cuts.npy").file_size
    true, stated = size.to_bytes(4, "little"), (1000).to_bytes(4, "little")
    assert true in content
    return bytes(content).replace(true, stated)


def lying_shape(arrays: dict[str, Any]) -> bytes:
    plain = io.BytesIO()
    with zipfile.ZipFile(plain, "w") as archive:
        archive.writestr("positions.npy", _npy(b"(999999999, 999999999)"))
    return plain.getvalue()


def deep_header(arrays: dict[str, Any]) -> bytes:
    plain = io.BytesIO()
    with zipfile.ZipFile(plain, "w") as archive:
        archive.writestr("positions.npy", _npy(b"(" * 9000))
    return plain.getvalue()


def unknown_compression(arrays: dict[str, Any]) -> bytes:
    plain = io.BytesIO()
    with zipfile.ZipFile(plain, "w", zipfile.ZIP_LZMA) as archive:
        archive.writestr("positions.npy", _npy(b"(0, 3)"))
    return plain.getvalue()


def no_archive(arrays: dict[str, Any]) -> bytes:
    return b"\0" * 100


def _npy(shape: bytes) -> bytes:
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + b", }\n"
    return b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header


@pytest.mark.parametrize(
    "side",
    [
        complex_numbers,
        words,
        whole_numbers,
        objects,
        records,
        too_few,
        other_cuts,
        unpacks_to_much,
        lying_sizes,
        lying_shape,
        deep_header,
        unknown_compression,
        no_archive,
    ],
)
def test_a_side_file_that_numpy_did_not_write_for_us_is_refused(
    side: Callable[[dict[str, Any]], bytes], golden_grasp: Grasp, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_with_side_file(tmp_path / "x.grasp.json", golden_grasp, side(arrays_of(golden_grasp)))
    refused(tmp_path / "x.grasp.json", capsys)


def test_a_foreign_or_missing_side_file_is_refused(
    golden_grasp: Grasp, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "x.grasp.json"
    side = write_with_side_file(path, golden_grasp, archived(arrays_of(golden_grasp)))
    side.write_bytes(side.read_bytes() + b" ")
    refused(path, capsys, "not the side file")
    side.unlink()
    refused(path, capsys, "side file")
    side.symlink_to(ENDLESS)
    refused(path, capsys, "is a device")
    side.unlink()
    os.mkfifo(side)
    refused(path, capsys, "is a pipe")
    side.unlink()
    side.mkdir()
    refused(path, capsys, "is a folder")


def test_whatever_byte_of_a_side_file_is_changed_the_answer_is_an_error_or_the_same_arrays(
    golden_grasp: Grasp, tmp_path: Path
) -> None:
    path, few = tmp_path / "x.grasp.json", random.Random(0)
    content = archived(arrays_of(golden_grasp))
    side = write_with_side_file(path, golden_grasp, content)
    text = path.read_text()
    sha256, answers = json.loads(text)["certificate"]["sha256"], set()
    for _ in range(300):
        changed = bytearray(content)
        for _ in range(few.choice([1, 1, 3, 30])):
            changed[few.choice([few.randrange(len(content)), -few.randrange(1, 500)])] = few.randrange(256)
        side.write_bytes(changed)
        path.write_text(text.replace(sha256, hashlib.sha256(changed).hexdigest()))
        try:
            np.testing.assert_array_equal(read_grasp(path).certificate.cuts, golden_grasp.certificate.cuts)
            answers.add("read")
        except GraspFileError:
            answers.add("refused")
    assert "refused" in answers


@pytest.mark.parametrize("fault", ["npz_corrupt_zlib", "npz_string_dtype", "npz_complex", "json_deep"])
def test_files_that_once_broke_it_are_refused(fault: str, capsys: pytest.CaptureFixture[str]) -> None:
    refused(shared("faults", fault, "f.grasp.json"), capsys)
