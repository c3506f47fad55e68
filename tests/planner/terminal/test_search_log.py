"""The search may speak as often as it likes: the log says ever less of it, and never leaves out the end."""

import json
from collections.abc import Sequence
from math import inf
from pathlib import Path

import pytest

from planner.errors import OutputError
from planner.search.result import Progress, Status
from planner.terminal.console import Console
from planner.terminal.search_log import RECORD_EVERY, SearchLog


def line(seconds: float) -> Progress:
    return Progress(
        seconds=seconds, nodes=int(100 * seconds), open=1, lower_bound=1.0, incumbent=inf, socp_solves=3, cuts=2
    )


def logged(path: Path | None, times: Sequence[float]) -> None:
    with SearchLog(Console(), path) as log:
        for seconds in times:
            log.observe(line(seconds))
        log.end(Status.TIME_LIMIT)


def test_printed_lines_grow_rarer_and_the_last_is_there(capsys: pytest.CaptureFixture[str]) -> None:
    logged(None, [k / 100 for k in range(10_000)])
    times = [float(row.split()[-1].removesuffix("s")) for row in capsys.readouterr().out.splitlines()]
    assert times == pytest.approx([0, 0.5, 1.5, 3.5, 7.5, 15.5, 31.5, 63.5, 99.99])


def test_json_lines_keep_up_and_end_with_the_status(tmp_path: Path) -> None:
    logged(tmp_path / "log.jsonl", [k / 100 for k in range(1000)])
    lines = [json.loads(text) for text in (tmp_path / "log.jsonl").read_text().splitlines()]
    times = [each["seconds"] for each in lines]
    assert times == sorted(times)
    assert len(lines) == pytest.approx(10 / RECORD_EVERY, abs=6)
    assert [each["status"] for each in lines] == [None] * (len(lines) - 1) + ["time_limit"]
    assert lines[-1]["seconds"] == 9.99
    assert lines[-1]["incumbent"] is None and lines[-1]["gap"] is None


def test_a_json_line_can_be_read_as_soon_as_it_is_told(tmp_path: Path) -> None:
    path = tmp_path / "log.jsonl"
    with SearchLog(Console(), path) as log:
        log.observe(line(0.0))
        assert json.loads(path.read_text())["nodes"] == 0


def test_a_file_that_cannot_be_written_is_refused_at_once(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot write"):
        SearchLog(Console(), tmp_path / "no" / "log.jsonl")
