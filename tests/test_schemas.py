"""The published JSON Schemas are those of the code, and real files follow them."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import write_grasp
from planner.objects.rigid_object import RigidObject
from scripts.publish_schemas import SCHEMAS
from sim.validation.document import write_validation
from sim.validation.validation import validate

TYPES: dict[str, Callable[[Any], bool]] = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "string": lambda value: isinstance(value, str),
    "boolean": lambda value: isinstance(value, bool),
    "null": lambda value: value is None,
    "integer": lambda value: isinstance(value, int) and not isinstance(value, bool),
    "number": lambda value: isinstance(value, int | float) and not isinstance(value, bool),
}


def errors(value: Any, schema: dict[str, Any], root: dict[str, Any], where: str = "$") -> list[str]:
    """What JSON Schema's words used here say against a value; unknown keys count as errors."""
    if "$ref" in schema:
        return errors(value, root["$defs"][schema["$ref"].removeprefix("#/$defs/")], root, where)
    if "anyOf" in schema:
        return [] if any(not errors(value, choice, root) for choice in schema["anyOf"]) else [f"{where}: no choice"]
    if "type" in schema and not TYPES[schema["type"]](value):
        return [f"{where}: not of type {schema['type']}"]
    found = []
    if value != schema.get("const", value) or value not in schema.get("enum", [value]):
        found.append(f"{where}: {value!r} not allowed")
    if "exclusiveMinimum" in schema and value <= schema["exclusiveMinimum"]:
        found.append(f"{where}: too small")
    if "properties" in schema:
        found += [f"{where}.{key}: missing" for key in schema.get("required", ()) if key not in value]
        found += [f"{where}.{key}: not in the schema" for key in value if key not in schema["properties"]]
        for key, part in schema["properties"].items():
            found += errors(value[key], part, root, f"{where}.{key}") if key in value else []
    if isinstance(value, list) and isinstance(schema.get("items"), dict):
        found += [error for item in value for error in errors(item, schema["items"], root, f"{where}[]")]
    return found


@pytest.mark.parametrize("path", SCHEMAS, ids=lambda path: path.name)
def test_the_published_schema_is_the_codes(path: Path) -> None:
    assert path.read_text() == SCHEMAS[path], "run scripts/publish_schemas.py"


def test_real_files_follow_the_published_schemas(golden_grasp: Grasp, prism: RigidObject, tmp_path: Path) -> None:
    validation = validate(prism, golden_grasp)
    write_grasp(tmp_path / "x.grasp.json", golden_grasp)
    write_validation(tmp_path / "x.validation.json", validation, grasp="x.grasp.json")
    for path in SCHEMAS:
        kind, schema = path.name.removesuffix(".schema.json"), json.loads(path.read_text())
        document = json.loads((tmp_path / f"x.{kind}.json").read_text())
        assert errors(document, schema, schema) == []
        for key in schema["$defs"][schema["$ref"].removeprefix("#/$defs/")]["required"]:
            assert errors({k: v for k, v in document.items() if k != key}, schema, schema) == [f"$.{key}: missing"]
        assert errors(document | {"format": "other"}, schema, schema)
