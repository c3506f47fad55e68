"""The committed lock is about these dependencies, and names no place but the public registry."""

import re
import tomllib
from pathlib import Path

from packaging.requirements import Requirement

from tests.tools.commands import ROOT

LOCK = ROOT / "uv.lock"


def locked() -> dict[str, set[str]]:
    """Versions of every locked package."""
    versions: dict[str, set[str]] = {}
    for package in tomllib.loads(LOCK.read_text())["package"]:
        versions.setdefault(package["name"], set()).add(package["version"])
    return versions


def requirements() -> list[Requirement]:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    asked = project["dependencies"] + [each for extra in project["optional-dependencies"].values() for each in extra]
    return [requirement for requirement in map(Requirement, asked) if requirement.name != project["name"]]


def test_every_dependency_is_locked_at_a_version_that_it_allows() -> None:
    versions = locked()
    assert len(requirements()) > 15
    for requirement in requirements():
        assert all(requirement.specifier.contains(version) for version in versions[requirement.name]), requirement


def test_the_lock_was_made_for_exactly_these_bounds() -> None:
    (own,) = [each for each in tomllib.loads(LOCK.read_text())["package"] if each["name"] == "rhograsp"]
    asked = own["metadata"]["requires-dist"]
    noted = {(each["name"], Requirement(f"x{each.get('specifier', '')}").specifier) for each in asked}
    assert {(each.name, each.specifier) for each in requirements()} <= noted, "run uv lock"


def test_the_lock_names_no_place_but_the_public_registry() -> None:
    assert set(re.findall(r"\w+://([^/\"]+)", LOCK.read_text())) == {"pypi.org", "files.pythonhosted.org"}
    assert not re.search(r"(registry|url|path) = \"(?!https://)", LOCK.read_text())


def test_the_lowest_versions_have_a_script_and_the_readme_installs_the_lock() -> None:
    assert "--resolution lowest-direct" in Path(ROOT / ".ci" / "lowest").read_text()
    assert "`uv sync --locked" in (ROOT / "README.md").read_text()
