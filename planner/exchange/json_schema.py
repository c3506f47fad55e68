"""JSON Schemas of the project's files, generated from the types that read and write them.

They are published in the package (`planner/grasps/schemas`, `sim/validation/schemas`), so that
other programs can check files without this one. `scripts/publish_schemas.py` writes them anew.
"""

import inspect
import json
from typing import Any

import msgspec

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def json_schema(document: type[msgspec.Struct], format: str, version: int) -> str:
    """The JSON Schema of one kind of file.

    Args:
        document: The type of the whole file.
        format: Value of its `format`.
        version: Value of its `format_version`.
    """
    (schema,), components = msgspec.json.schema_components([document], ref_template="#/$defs/{name}")
    definitions: dict[str, Any] = components
    for definition in definitions.values():
        if "description" in definition:
            definition["description"] = inspect.cleandoc(definition["description"])
    stated = definitions[document.__name__]["properties"]
    stated["format"], stated["format_version"] = {"const": format}, {"const": version}
    published = {"$schema": DIALECT, "title": f"{format} {version}", **schema, "$defs": definitions}
    return json.dumps(published, indent=1, ensure_ascii=False) + "\n"
