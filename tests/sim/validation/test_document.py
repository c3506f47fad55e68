"""The validation file carries the whole outcome and is written completely or not at all."""

from dataclasses import asdict, replace
from functools import cache
from pathlib import Path

import msgspec
import numpy as np
import pytest

from planner.errors import OutputError
from planner.files.json_document import as_rows
from planner.files.versioned_document import document_text
from sim.trial.protocol import ACTIVE
from sim.validation.document import (
    FORMAT,
    CapRecord,
    ValidationDocument,
    read_validation,
    to_document,
    write_validation,
)
from sim.validation.validation import Validation
from sim.validation.verdict import Verdict
from tests.strategies.planned_grasps import prism


@cache
def refuted() -> Validation:
    """A validation of every fourth wrench, with something to say."""
    return replace(prism(), wrenches=prism().wrenches[::4]).validated(rho_error=0.97)


def test_what_is_written_is_read_back_equal(tmp_path: Path) -> None:
    path = tmp_path / "prism.validation.json"
    write_validation(path, refuted(), grasp="prism.grasp.json")
    document = msgspec.json.decode(path.read_bytes(), type=ValidationDocument)
    assert document == to_document(refuted(), grasp="prism.grasp.json")
    assert (document.format, document.format_version) == (FORMAT, 1)
    assert document.verdict is Verdict.FAIL and document.reasons
    assert len(document.vertices) == 16
    assert [control.name for control in document.controls] == ["cap", "creep", "friction", "displaced contact"]
    assert document.critical_force is None and document.beyond == ()
    assert [path] == list(tmp_path.iterdir())


def test_every_setting_of_the_protocol_is_recorded(tmp_path: Path) -> None:
    path = tmp_path / "prism.validation.json"
    write_validation(path, refuted())
    recorded = msgspec.json.decode(path.read_bytes())["protocol"]
    expected = msgspec.json.decode(msgspec.json.encode(asdict(ACTIVE)))
    assert recorded == expected


def test_vertices_tell_which_finger_slipped_at_which_force() -> None:
    validation = refuted()
    assert validation.vertices is not None
    document = to_document(validation)
    failed = next(record for record in document.vertices if not record.held)
    assert failed.slip == max(finger.slip for finger in failed.fingers if finger.loaded)
    assert failed.phi == pytest.approx(validation.grasp.phi[failed.wrench])
    assert failed.cap == pytest.approx(1.02 * validation.grasp.rho)


def test_columns_become_rows_and_what_is_infinite_null() -> None:
    rows = as_rows(CapRecord, wrench=range(2), phi=np.ones(2), lower=[0, 2], upper=np.array([2, np.inf]), ratio=[1, 2])
    assert [row.wrench for row in rows] == [0, 1] and [row.upper for row in rows] == [2.0, None]
    with pytest.raises(ValueError, match="shorter"):
        as_rows(CapRecord, wrench=range(2), phi=np.ones(1), lower=[0, 2], upper=[2, 3], ratio=[1, 2])


def test_a_file_of_old_is_read_and_whether_a_control_behaved_follows_from_its_outcomes(tmp_path: Path) -> None:
    path = tmp_path / "old.validation.json"
    content = msgspec.json.decode(document_text(to_document(refuted())))
    del content["strengths"], content["friction_limited"]
    content["controls"][0]["outcomes"][0] |= {"wrench": None, "phi": None, "held": True, "expected": False}
    assert content["controls"][0]["behaved"]
    path.write_bytes(msgspec.json.encode(content))
    document = read_validation(path)
    assert (document.strengths, document.friction_limited) == ((), ())
    assert document.controls[1:] == refuted().controls[1:] and not document.controls[0].behaved


def test_a_folder_that_is_not_there_is_reported(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot write"):
        write_validation(tmp_path / "missing" / "prism.json", refuted())
