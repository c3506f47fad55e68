"""What the README tells people to type works, and says what it says."""

import re
import shlex
from pathlib import Path

import pytest

from planner.terminal.command_line import EXIT_CODES
from tests.tools.commands import MAINS, ROOT, run

README = (ROOT / "README.md").read_text()

RESULTS = sorted((ROOT / "assets" / "results").glob("*.md"))

MOST_LINES = 200


def links(page: Path) -> list[str]:
    """Files that a page links or shows, relative to it."""
    return [link for link in re.findall(r"\]\(([^)#]+)\)", page.read_text()) if "://" not in link]


def blocks(language: str) -> list[str]:
    """Contents of the fenced blocks of a language; the empty name is plain text."""
    fenced = re.findall(r"^```(\w*)\n(.*?)^```", README, flags=re.DOTALL | re.MULTILINE)
    return [content for name, content in fenced if name == language]


def test_every_grasp_command_of_the_readme_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    monkeypatch.chdir(tmp_path)
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    commands = [command.strip() for block in blocks("sh") for command in block.split("&&") if "bin/grasp-" in command]
    assert len(commands) >= 2
    for command in commands:
        name, *arguments = shlex.split(command)
        assert run(Path(name).name, *arguments) == 0, command
    assert opened == [(tmp_path / "prism.report.html").resolve().as_uri()]


@pytest.mark.slow
def test_the_python_example_of_the_readme_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    monkeypatch.chdir(tmp_path)
    (example,) = blocks("python")
    exec(compile(example, "README.md", "exec"), {})
    assert re.search(r"^\d+\.\d+ N, proven to 0\.\d+%.*^True pass$", capsys.readouterr().out, re.MULTILINE | re.DOTALL)
    assert (tmp_path / "mug.grasp.json").is_file()


def test_ci_runs_the_readmes_test_command() -> None:
    (command,) = [line for block in blocks("sh") for line in block.splitlines() if "bin/pytest" in line]
    assert command in (ROOT / ".ci" / "run").read_text().splitlines()


def test_the_readme_names_every_command_and_exit_code() -> None:
    for command in MAINS:
        assert f"`{command} " in README
    assert " ".join(README.split()).find(EXIT_CODES.removeprefix("exit codes: ")) > 0


def test_the_tree_of_the_readme_exists() -> None:
    (tree,) = [block for block in blocks("") if "planner/  " in block]
    folder = ""
    for line in tree.splitlines():
        names = re.findall(r"^\s*((?:[\w.]+(?:\.py|/)\s+)+)", line + "  ")
        for name in names[0].split() if names else ():
            folder = name if not line.startswith(" ") else folder
            assert (ROOT / name).exists() or (ROOT / folder / name).exists(), name


def test_the_readme_stays_short_and_what_it_links_exists() -> None:
    assert len(README.splitlines()) <= MOST_LINES
    pages = {ROOT / "README.md", *RESULTS}
    assert {ROOT / link for link in links(ROOT / "README.md")} >= set(RESULTS)
    for page in pages:
        for link in links(page):
            assert (page.parent / link).exists(), f"{page.name} links {link}"


@pytest.mark.parametrize("page", RESULTS, ids=lambda page: page.stem)
def test_every_page_of_results_names_its_command_date_and_version(page: Path) -> None:
    text = page.read_text()
    assert (ROOT / re.findall(r"`python\s+(scripts/\w+\.py) ", text)[0]).is_file()
    assert re.search(r"version 0\.1\.0", text) and re.search(r"\b20\d\d-\d\d-\d\d\b", text)
    assert re.search(r"two (busy )?cores", text, re.IGNORECASE)
