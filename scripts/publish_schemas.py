"""Write the published JSON Schemas anew, after a change to the grasp or the validation file."""

from pathlib import Path

from planner.exchange.json_schema import json_schema
from planner.files.atomic_write import write_atomically
from planner.grasps import document as grasp_document
from sim.validation import document as validation_file

ROOT = Path(__file__).resolve().parents[1]

SCHEMAS = {
    ROOT / "planner" / "grasps" / "schemas" / "grasp.schema.json": json_schema(
        grasp_document.GraspDocument, grasp_document.FORMAT, grasp_document.FORMAT_VERSION
    ),
    ROOT / "sim" / "validation" / "schemas" / "validation.schema.json": json_schema(
        validation_file.ValidationDocument, validation_file.FORMAT, validation_file.FORMAT_VERSION
    ),
}
"""What is published where."""

if __name__ == "__main__":
    for path, schema in SCHEMAS.items():
        write_atomically(path, schema.encode())
        print(f"wrote {path.relative_to(ROOT)}")
