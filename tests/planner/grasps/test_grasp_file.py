"""A grasp file is read back exactly, or refused with a reason."""

import errno
import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.candidates.candidates import CandidateChoice
from planner.errors import GraspFileError, OutputError
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import read_grasp, write_grasp
from planner.verification.verify import verify


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


def test_limits_survive_the_file(limited_grasp: Grasp, tmp_path: Path) -> None:
    path = tmp_path / "limited.grasp.json"
    write_grasp(path, limited_grasp)
    grasp = read_grasp(path)
    assert grasp.contacts.strengths.tolist() == [1.0, 1.0, 0.5]
    for name in ("kinds", "spacing", "span"):
        assert getattr(grasp.certificate, name) == getattr(limited_grasp.certificate, name), name
    assert (grasp.certificate.spacing, grasp.certificate.span) == (0.02, 0.028)
    np.testing.assert_array_equal(grasp.certificate.strengths, limited_grasp.certificate.strengths)
    assert grasp.rho == limited_grasp.rho


def test_a_file_without_limits_does_not_speak_of_them(golden_file: Path) -> None:
    document = json.loads(golden_file.read_text())
    assert set(document["contacts"][0]) == {"position", "normal", "friction", "geom", "candidate"}
    assert set(document["certificate"]) == {"candidates", "cuts"}


def strengthen_finger(document: dict[str, Any]) -> None:
    document["contacts"][2]["strength"] = 1.0


def strengthen_kind(document: dict[str, Any]) -> None:
    document["certificate"]["kinds"][1]["strength"] = 1.0


def forget_kinds(document: dict[str, Any]) -> None:
    del document["certificate"]["kinds"]


def add_finger(document: dict[str, Any]) -> None:
    document["certificate"]["kinds"][0]["fingers"] = 3


def give_candidates(document: dict[str, Any]) -> None:
    document["certificate"]["kinds"][0]["candidates"] += 1


def cross_distances(document: dict[str, Any]) -> None:
    document["certificate"]["spacing"] = 1.0


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (strengthen_finger, "strength does not agree"),
        (strengthen_kind, "strength does not agree"),
        (forget_kinds, "subsets are stated"),
        (add_finger, "do not add up to 3 fingers"),
        (give_candidates, "kinds of fingers for 435 candidates, of which there are 434"),
        (cross_distances, "least distance between two contacts"),
    ],
)
def test_edited_limits_are_refused(
    limited_grasp: Grasp, tmp_path: Path, edit: Callable[[dict[str, Any]], None], message: str
) -> None:
    path = tmp_path / "limited.grasp.json"
    write_grasp(path, limited_grasp)
    document = json.loads(path.read_text())
    edit(document)
    path.write_text(json.dumps(document))
    with pytest.raises(GraspFileError, match=message):
        read_grasp(path)


def test_how_it_was_made_survives_the_file(golden_grasp: Grasp, golden_file: Path) -> None:
    assert read_grasp(golden_file).command is None  # made from Python
    chosen = CandidateChoice(candidates="case3", friction=0.3, seed=0, confirmed=False, limited=False)
    assert golden_grasp.candidate_choice == chosen
    first = replace(golden_grasp.search.trace[0], incumbent=None)
    search = replace(golden_grasp.search, trace=(first, *golden_grasp.search.trace))
    made = replace(golden_grasp, search=search, command="grasp-plan 'a  [b   c] {\"seconds\":  1}.xml' --com 0 0 1")
    write_grasp(golden_file, made)
    grasp = read_grasp(golden_file)
    assert (grasp.command, grasp.candidate_choice, grasp.search) == (made.command, made.candidate_choice, search)
    lines = golden_file.read_text().splitlines()
    assert sum(line.strip().startswith('{ "seconds"') for line in lines) == len(search.trace)  # a line is a line


def test_a_file_from_before_these_were_kept_is_read(golden_grasp: Grasp, golden_file: Path) -> None:
    document = json.loads(golden_file.read_text())
    del document["search"]["trace"], document["planner"]["command"], document["candidate_choice"]
    golden_file.write_text(json.dumps(document))
    grasp = read_grasp(golden_file)
    assert (grasp.search.trace, grasp.command, grasp.candidate_choice) == ((), None, None)
    assert grasp.search == replace(golden_grasp.search, trace=())
    assert [check.claim for check in verify(grasp) if not check.holds] == [
        "the candidates have the friction of their geoms",
        "no candidate was left out or added",
    ]
    assert not any(check.fails for check in verify(grasp))


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
    assert {"seconds", "nodes", "open", "lower_bound", "incumbent", "socp_solves", "cuts"} == set(
        document["search"]["trace"][0]
    )
    assert {"candidates", "friction", "friction_error", "fingertip", "seed"} < set(document["candidate_choice"])
    assert {"version", "packages", "command"} <= set(document["planner"])
    assert document["format"] == "rhograsp.grasp"
    assert set(document["certificate"]["candidates"]) == {"positions", "normals", "friction"}
    loads = (-np.array(document["certificate"]["cuts"]) @ np.array(document["task"]["wrenches"]).T).max(axis=1)
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


def cut_off_the_log(document: dict[str, Any]) -> None:
    del document["search"]["trace"][-1]


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (grow_fingers, "1000 fingers"),
        (cut_off_the_log, "search log ends with"),
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


def test_soft_fingers_and_their_torques_come_back(soft_grasp: Grasp, tmp_path: Path) -> None:
    path = tmp_path / "box.grasp.json"
    write_grasp(path, soft_grasp)
    back = read_grasp(path)
    for one, other in ((back.torques, soft_grasp.torques), (back.contacts.torsions, soft_grasp.contacts.torsions)):
        assert one.any()
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(back.certificate.candidates.torsions, soft_grasp.certificate.candidates.torsions)


def test_a_torque_of_a_hard_finger_is_refused(golden_file: Path) -> None:
    document = json.loads(golden_file.read_text())
    assert document["torques"] is None
    document["torques"] = [[0.0] * 3] * len(document["phi"])
    golden_file.write_text(json.dumps(document))
    assert not read_grasp(golden_file).torques.any()
    document["torques"] = [[0.0, 1e-9, 0.0]] * len(document["phi"])
    golden_file.write_text(json.dumps(document))
    with pytest.raises(GraspFileError, match="a torque is given at a contact without torsional friction"):
        read_grasp(golden_file)


def lose_a_row(document: dict[str, Any]) -> None:
    del document["certificate"]["candidates"]["normals"][5]


def shorten_a_row(document: dict[str, Any]) -> None:
    del document["certificate"]["candidates"]["positions"][5][2]


def shorten_a_cut(document: dict[str, Any]) -> None:
    del document["certificate"]["cuts"][5][2]


def shorten_all_cuts(document: dict[str, Any]) -> None:
    for cut in document["certificate"]["cuts"]:
        del cut[2]


def forget_candidates(document: dict[str, Any]) -> None:
    document["certificate"]["candidates"] = {"positions": [], "normals": [], "friction": []}


def name_a_huge_candidate(document: dict[str, Any]) -> None:
    document["contacts"][0]["candidate"] = 10**30


@pytest.mark.parametrize(
    "edit", [lose_a_row, shorten_a_row, shorten_a_cut, shorten_all_cuts, forget_candidates, name_a_huge_candidate]
)
def test_an_edited_certificate_is_refused(golden_file: Path, edit: Callable[[dict[str, Any]], None]) -> None:
    document = json.loads(golden_file.read_text())
    edit(document)
    golden_file.write_text(json.dumps(document))
    with pytest.raises(GraspFileError, match=r"not a (consistent )?grasp file"):
        read_grasp(golden_file)


def test_a_row_is_a_line(golden_grasp: Grasp, golden_file: Path) -> None:
    lines = [line.strip().rstrip(",") for line in golden_file.read_text().splitlines()]
    rows = [json.loads(line) for line in lines if line.startswith("[") and len(line) > 1]
    for position in golden_grasp.certificate.candidates.points.tolist():
        assert position in rows


def test_a_truncated_file_is_refused(golden_file: Path) -> None:
    golden_file.write_bytes(golden_file.read_bytes()[:1000])
    with pytest.raises(GraspFileError, match="truncated"):
        read_grasp(golden_file)


def no_space_left(_: int) -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_failed_write_leaves_the_old_file(
    golden_grasp: Grasp, golden_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(OutputError, match="choose a folder"):
        write_grasp(golden_file.parent / "missing" / "x.grasp.json", golden_grasp)
    before = golden_file.read_bytes()
    with monkeypatch.context() as full:
        full.setattr("os.fsync", no_space_left)
        with pytest.raises(OutputError, match="No space left"):
            write_grasp(golden_file, replace(golden_grasp, command="other"))
    assert golden_file.read_bytes() == before
    assert [path.name for path in golden_file.parent.iterdir() if path.name.startswith(".")] == []
