"""Mappings, lists of numbers and scalars as YAML text that every YAML 1.1 and 1.2 reader understands alike.

Strings are always quoted, so that none turns into a number or a truth value, and floats always carry a point, so that
no reader takes 1e-05 for a string.
"""

from collections.abc import Mapping, Sequence

Value = Mapping[str, "Value"] | Sequence[float] | str | float


def yaml_text(document: Mapping[str, Value], indent: int = 0) -> str:
    """The document in block style, lists in one line each.

    Args:
        document: Mappings may be nested; lists hold numbers.
        indent: Spaces before every line.
    """
    lines = []
    for key, value in document.items():
        start = f"{' ' * indent}{_quoted(key)}:"
        if isinstance(value, Mapping) and value:
            lines.append(f"{start}\n{yaml_text(value, indent + 2)}")
        else:
            lines.append(f"{start} {_scalar(value)}\n")
    return "".join(lines)


def _scalar(value: Value) -> str:
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, Mapping):
        return "{}"
    if isinstance(value, int | float):
        return _number(value)
    return f"[{', '.join(map(_number, value))}]"


def _number(value: float) -> str:
    text = repr(value)
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _quoted(text: str) -> str:
    plain = (c if " " <= c <= "~" and c not in '"\\' else f"\\U{ord(c):08x}" for c in text)
    return f'"{"".join(plain)}"'
