"""One reader and one writer of versioned documents: foreign, newer and older files are told from broken ones."""

import json
from pathlib import Path

import msgspec
import pytest

from planner.errors import GraspFileError, OutputError
from planner.files.versioned_document import DocumentFormat, write_document


class Note(msgspec.Struct, frozen=True):
    """A document of the format below."""

    format: str
    format_version: int
    text: str


NOTES = DocumentFormat(name="a.note", version=3, oldest=2, called="note", remedy="write it again")


@pytest.mark.parametrize("version", [2, 3])
def test_what_is_written_is_read_in_every_version_that_is_known(version: int, tmp_path: Path) -> None:
    write_document(tmp_path / "x.json", Note("a.note", version, "é"))
    content, read = NOTES.read(tmp_path / "x.json")
    assert read == version
    assert msgspec.json.decode(content, type=Note).text == "é"
    assert content.endswith(b"}\n") and content.count(b"\n") == 5


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ({"format": "another", "format_version": 3}, "has format 'another'; expected 'a.note'"),
        ({"format": "a.note", "format_version": 4}, "format version 4; this program reads 2 to 3; write it again"),
        ({"format": "a.note", "format_version": 1}, "format version 1; this program reads 2 to 3; write it again"),
        ({"format": "a.note"}, "is not a note, or is truncated"),
        ([], "is not a note, or is truncated"),
    ],
)
def test_every_other_file_is_refused_by_what_is_wrong_with_it(document: object, message: str, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    path.write_text(json.dumps(document))
    with pytest.raises(GraspFileError, match=message):
        NOTES.read(path)


def test_a_document_that_cannot_be_written_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot write"):
        write_document(tmp_path / "missing" / "x.json", Note("a.note", 3, ""))
    assert not list(tmp_path.iterdir())
