"""Whoever alters a grasp file is noticed, or has said nothing false: the table of `forgeries`, row by row."""

import json
from pathlib import Path

import pytest

from planner.errors import GraspFileError, ObjectError
from planner.grasps.grasp_file import read_grasp
from planner.grasps.grasped_object import read_grasped_object
from planner.verification.check import Check
from planner.verification.provenance.provenance import check_provenance, require_provenance
from planner.verification.verify import verify
from tests.strategies.filed_plans import document_of, preset_plan, soft_plan
from tests.strategies.forgeries import FORGERIES, NOBODY, OBJECT, PROOF, READING, UNCHECKED, Forgery
from tests.strategies.soft_forgeries import SOFT_FORGERIES
from tests.tools.commands import run
from tests.tools.lanes import first_fast

FOREIGN = [each for each in FORGERIES if each.noticed is OBJECT]
"""What does not belong to its object."""


@pytest.fixture(scope="module")
def true_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return preset_plan(tmp_path_factory.mktemp("true"))


@pytest.fixture(scope="module")
def soft_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return soft_plan(tmp_path_factory.mktemp("soft"))


def forged(true_file: Path, forgery: Forgery) -> Path:
    """The altered file, beside the true one."""
    document = document_of(true_file)
    forgery.alter(document)
    file = true_file.with_name("forged.grasp.json")
    file.write_text(json.dumps(document))
    return file


def notices(file: Path) -> str:
    """Who notices, the first of those that would."""
    try:
        grasp = read_grasp(file)
    except GraspFileError:
        return READING
    if any(check.fails for check in check_provenance(grasp)):
        return OBJECT
    checks = verify(grasp)
    if any(check.fails for check in checks):
        return PROOF
    return NOBODY if all(check.holds for check in checks) else UNCHECKED


def test_the_true_file_is_true_to_the_last_claim(true_file: Path) -> None:
    checks: tuple[Check, ...] = verify(read_grasp(true_file))
    assert [check.claim for check in checks if not check.holds] == []
    assert len(checks) == 14


@pytest.mark.parametrize("forgery", first_fast(FORGERIES, fast=30), ids=lambda forgery: forgery.name)
def test_a_forged_field_is_noticed_or_says_nothing_false(true_file: Path, forgery: Forgery) -> None:
    assert notices(forged(true_file, forgery)) == forgery.noticed
    assert bool(forgery.why) == (forgery.noticed is NOBODY)


def test_the_true_soft_file_twists_and_is_true_to_the_last_claim(soft_file: Path) -> None:
    grasp = read_grasp(soft_file)
    assert all(check.holds for check in verify(grasp))
    assert (abs(grasp.torques) > 1e-3 * grasp.rho * grasp.contacts.torsions.max()).any()


@pytest.mark.parametrize("forgery", SOFT_FORGERIES, ids=lambda forgery: forgery.name)
def test_forged_torsional_friction_is_noticed_or_says_nothing_false(soft_file: Path, forgery: Forgery) -> None:
    assert notices(forged(soft_file, forgery)) == forgery.noticed
    assert bool(forgery.why) == (forgery.noticed is NOBODY)


@pytest.mark.parametrize(
    "forgery",
    first_fast(FOREIGN, fast=10),
    ids=lambda forgery: forgery.name,
)
def test_what_does_not_belong_to_its_object_is_not_simulated(true_file: Path, forgery: Forgery) -> None:
    grasp = read_grasp(forged(true_file, forgery))
    with pytest.raises((GraspFileError, ObjectError)):
        require_provenance(grasp, read_grasped_object(grasp))


def test_validating_says_what_it_could_not_compare(true_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (forgery,) = [each for each in FORGERIES if each.name == "task: preset forgotten, another name"]
    file = forged(true_file, forgery)
    assert run("grasp-validate", file, "--out", true_file.with_name("own.validation.json")) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("unchecked")]
    assert "task 'mine'" in line and "caller's own" in line


@pytest.mark.parametrize(
    "name",
    [
        "object: mass doubled",
        "task: all loads a tenth",
        "contact: geoms swapped",
        "choice: one more",
        "candidates: others weakened",
        "candidates: two thirds deleted, count not",
        "candidates, contacts and reference point moved 1 cm",
    ],
)
def test_both_commands_refuse_a_forged_file_in_one_line(
    true_file: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (forgery,) = [each for each in FORGERIES if each.name == name]
    file = forged(true_file, forgery)
    out = true_file.with_name("forged.validation.json")
    assert run("grasp-validate", file, "--out", out, "-q") == 1
    refused = capsys.readouterr().err
    assert refused.startswith("error: ") and refused.count("\n") == 1
    assert not out.exists()
    assert run("grasp-verify", file) == (1 if forgery.noticed is READING else 5)
    assert forgery.noticed is READING or "FAIL" in capsys.readouterr().out
