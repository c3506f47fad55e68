"""A grasp file is read back exactly, or refused with a reason."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.errors import GraspFileError, OutputError
from planner.grasp import Grasp
from planner.grasp_file import certificate_path, read_grasp, write_grasp


def test_everything_survives_the_file(golden_grasp: Grasp, golden_file: Path) -> None:
    grasp = read_grasp(golden_file)
    np.testing.assert_array_equal(grasp.forces, golden_grasp.forces)
    np.testing.assert_array_equal(grasp.phi, golden_grasp.phi)
    np.testing.assert_array_equal(grasp.task.wrenches, golden_grasp.task.wrenches)
    np.testing.assert_array_equal(grasp.contacts.points, golden_grasp.contacts.points)
    np.testing.assert_array_equal(grasp.certificate.cuts, golden_grasp.certificate.cuts)
    np.testing.assert_array_equal(grasp.certificate.candidates.normals, golden_grasp.certificate.candidates.normals)
    assert grasp.file.resolve() == golden_grasp.file.resolve()
    for name in ("sha256", "body", "mass", "geoms", "rho", "lower_bound", "gap", "status", "critical_wrench", "search"):
        assert getattr(grasp, name) == getattr(golden_grasp, name), name


def test_key_names_are_the_contract(golden_file: Path) -> None:
    document = json.loads(golden_file.read_text())
    assert {
        "format", "format_version", "object", "task", "contacts", "rho", "lower_bound", "gap", "status",
        "critical_wrench", "phi", "forces", "search", "certificate", "planner",
    } <= set(document)  # fmt: skip
    assert {"mjcf", "sha256", "body", "mass"} <= set(document["object"])
    assert {"name", "reference_point", "wrenches"} <= set(document["task"])
    assert {"position", "normal", "friction", "geom", "candidate"} <= set(document["contacts"][0])
    assert {"method", "candidates", "subsets", "nodes", "socp_solves", "cuts", "seconds", "seed"} <= set(
        document["search"]
    )
    assert {"version", "packages"} <= set(document["planner"])
    assert document["format"] == "rhograsp.grasp"
    with np.load(golden_file.parent / document["certificate"]["file"]) as arrays:
        assert set(arrays) == {"positions", "normals", "friction", "cuts"}
        loads = (-arrays["cuts"] @ np.array(document["task"]["wrenches"]).T).max(axis=1)
    np.testing.assert_allclose(loads, 1.0)


def halve_rho(document: dict[str, Any]) -> None:
    document["rho"] /= 2


def scale_forces(document: dict[str, Any]) -> None:
    document["forces"] = (0.9 * np.array(document["forces"])).tolist()


def move_contact(document: dict[str, Any]) -> None:
    document["contacts"][0]["position"][0] += 0.001


def bend_normal(document: dict[str, Any]) -> None:
    document["contacts"][0]["normal"] = [0.5, 0.5, 0.5]


def forget_contact(document: dict[str, Any]) -> None:
    del document["contacts"][0]


def repeat_candidate(document: dict[str, Any]) -> None:
    document["contacts"][1]["candidate"] = document["contacts"][0]["candidate"]


def come_from_the_future(document: dict[str, Any]) -> None:
    document["format_version"] = 99


def be_something_else(document: dict[str, Any]) -> None:
    document["format"] = "isaac_grasp"


def lose_friction(document: dict[str, Any]) -> None:
    document["contacts"][0]["friction"] = -0.3


def grow_fingers(document: dict[str, Any]) -> None:
    document["search"]["fingers"] = 1000


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (grow_fingers, "1000 fingers"),
        (halve_rho, "rho does not agree"),
        (scale_forces, "phi does not agree"),
        (move_contact, "position does not agree"),
        (bend_normal, "not a unit vector"),
        (forget_contact, "2 contacts for 3 fingers|not a consistent"),
        (repeat_candidate, "repeated or out of range"),
        (come_from_the_future, "format version 99"),
        (be_something_else, "isaac_grasp"),
        (lose_friction, "friction|> 0"),
    ],
)
def test_an_edited_file_is_refused(golden_file: Path, edit: Callable[[dict[str, Any]], None], message: str) -> None:
    document = json.loads(golden_file.read_text())
    edit(document)
    golden_file.write_text(json.dumps(document))
    with pytest.raises(GraspFileError, match=message):
        read_grasp(golden_file)


def test_a_truncated_file_is_refused(golden_file: Path) -> None:
    golden_file.write_bytes(golden_file.read_bytes()[:1000])
    with pytest.raises(GraspFileError, match="truncated"):
        read_grasp(golden_file)


def test_a_foreign_or_missing_side_file_is_refused(golden_file: Path) -> None:
    side = certificate_path(golden_file)
    side.write_bytes(side.read_bytes() + b" ")
    with pytest.raises(GraspFileError, match="not the side file"):
        read_grasp(golden_file)
    side.unlink()
    with pytest.raises(GraspFileError, match="side file"):
        read_grasp(golden_file)


def test_a_failed_write_leaves_the_old_file(golden_grasp: Grasp, golden_file: Path) -> None:
    with pytest.raises(OutputError, match="choose a folder"):
        write_grasp(golden_file.parent / "missing" / "x.grasp.json", golden_grasp)
    before = golden_file.read_bytes()
    certificate_path(golden_file).unlink()
    certificate_path(golden_file).mkdir()  # replacing it must fail, and the JSON must stay as it was
    with pytest.raises(OutputError):
        write_grasp(golden_file, golden_grasp)
    assert golden_file.read_bytes() == before
    assert [path.name for path in golden_file.parent.iterdir() if path.name.startswith(".")] == []
