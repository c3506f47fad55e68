"""Enough YAML for the test of one writer: nested mappings, flow lists of numbers, quoted strings. YAML 1.1's floats."""

import re
from typing import Any

FLOAT = re.compile(r"[-+]?[0-9][0-9_]*\.[0-9_]*([eE][-+][0-9]+)?|[-+]?[0-9]+")
"""What PyYAML takes for a number: 1e-05, without a point, is a string to it."""


def read_yaml(text: str) -> dict[str, Any]:
    """The document."""
    root: dict[str, Any] = {}
    levels = [(-1, root)]
    for line in text.splitlines():
        indent = len(line) - len(line.lstrip())
        match = re.fullmatch(r'\s*("(?:[^"\\]|\\.)*"):(?: (.*))?', line)
        assert match, line
        while levels[-1][0] >= indent:
            levels.pop()
        key, value = _scalar(match[1]), match[2]
        levels[-1][1][key] = child = {} if value is None else _scalar(value)
        if value is None:
            levels.append((indent, child))
    return root


def _scalar(text: str) -> Any:
    if text == "{}":
        return {}
    if text.startswith("["):
        return [_scalar(item) for item in text[1:-1].split(", ")]
    if text.startswith('"'):
        return re.sub(r"\\U([0-9a-f]{8})", lambda code: chr(int(code[1], 16)), text[1:-1])
    assert FLOAT.fullmatch(text), f"{text} would be read as a string"
    return float(text)
