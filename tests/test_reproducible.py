"""A grasp file says how to make it again, in words that work."""

import json
import shlex
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.tools.commands import ASSETS, run


@pytest.mark.slow
def test_the_command_in_a_file_makes_the_same_grasp_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(ASSETS / "box" / "box.xml", "my box.xml")
    file = tmp_path / "box.grasp.json"
    typed = ["my box.xml", "--candidates", "60", "--seed", "3", "--friction", "0.6", "--out", file.name, "-q"]
    assert run("grasp-plan", *typed) == 0
    first: dict[str, Any] = json.loads(file.read_text())
    command = first["planner"]["command"]
    assert shlex.split(command) == ["grasp-plan", *typed]
    assert str(tmp_path) not in file.read_text()
    asked = {"candidates": "60", "friction": 0.6, "friction_error": 0.0, "fingertip": None, "seed": 3}
    assert {key: first["candidate_choice"][key] for key in asked} == asked
    file.unlink()
    assert run(*shlex.split(command)) == 0
    again = json.loads(file.read_text())
    for key in ("object", "task", "contacts", "rho", "lower_bound", "phi", "forces", "status", "candidate_choice"):
        assert again[key] == first[key], key
