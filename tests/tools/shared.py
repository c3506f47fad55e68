"""Files that nobody here made, beside the project where they are present: objects, hands, cases, faults."""

from pathlib import Path

import pytest

from tests.tools.commands import ROOT

SHARED = ROOT.parent / "shared"
"""Never part of the project."""


def shared(*parts: str) -> Path:
    """A file or folder of the shared ones; the test is skipped where it is not there."""
    path = SHARED.joinpath(*parts)
    if not path.exists():
        pytest.skip(f"{'/'.join(parts)} of the shared files is not here")
    return path
