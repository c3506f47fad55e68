"""`grasp-report` joins a grasp with its own validation, and with no other."""

import json
from pathlib import Path

import pytest

from tests.tools.browser import visit
from tests.tools.commands import PRISM, run, says


@pytest.mark.slow
def test_the_command_shows_the_measurement_beside_the_grasp(
    golden_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("grasp-report", golden_file) == 0
    assert says(capsys.readouterr().out, "wrote golden.report.html .no validation found")
    assert run("grasp-validate", golden_file, "--quiet") == 0
    assert run("grasp-report", golden_file) == 0
    assert says(capsys.readouterr().out, "with .*golden.validation.json")
    page = visit(Path("golden.report.html").resolve(), profile=tmp_path / "profile")
    assert page.console == ()
    assert says(page.dom, "64 of 64 wrenches held with the finger force capped at 1.02 rho")
    scatter = page.dom[page.dom.index('id="scatter"') :]
    assert scatter[: scatter.index("</svg>")].count("<circle") == 64 * 3
    assert page.dom.count('<td class="ok">as predicted') == 4


@pytest.mark.slow
def test_a_validation_of_another_grasp_is_refused(
    golden_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("grasp-validate", golden_file, "--quiet") == 0
    result = tmp_path / "golden.validation.json"
    document = json.loads(result.read_text())
    for changes, message in (
        ({"rho": 0.5}, "another grasp"),
        ({"format_version": 0}, "version 0"),
        ({"vertices": 3}, "not a validation file"),
    ):
        result.write_text(json.dumps(document | changes))
        assert run("grasp-report", golden_file) == 1
        assert says(capsys.readouterr().err, f"^error: .*{message}")
    assert run("grasp-report", golden_file, golden_file, "--out", "x.html") == 1
    assert says(capsys.readouterr().err, "single file")


def test_a_search_without_a_grasp_has_a_page_and_no_validation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("grasp-plan", PRISM, "--fingers", 1, "--candidates", 20, "--out", "none.grasp.json", "-q") == 3
    (tmp_path / "none.validation.json").write_text("left over from an earlier grasp")
    assert run("grasp-report", "none.grasp.json") == 0
    assert says(capsys.readouterr().out, r"wrote none\.report\.html \(no grasp: infeasible\)")
    assert run("grasp-report", "none.grasp.json", "--validation", "none.validation.json") == 1
    assert says(capsys.readouterr().err, "^error: none.grasp.json holds no grasp .*is not about it")
