"""Which cases of a test the fast lane takes."""

from collections.abc import Iterable
from typing import Any

import pytest


def first_fast(cases: Iterable[object], fast: int = 1) -> list[Any]:
    """Parameters of a test, all but the first few marked slow: the fast lane meets the kind, the whole suite each."""
    every = [case if isinstance(case, tuple) else (case,) for case in cases]
    return [pytest.param(*case, marks=[pytest.mark.slow] * (number >= fast)) for number, case in enumerate(every)]
