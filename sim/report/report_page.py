"""A grasp as one HTML page that works without a network: the object in 3-D, forces, proof and measurement.

Names come from files, so nothing of them may become markup: the data is one JSON document in which `<`, `>` and `&`
are escaped, the page's scripts write text only, and its security policy knows just those scripts and no network.
"""

import base64
import hashlib
import html
import json
import re
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from planner.files.atomic_write import write_atomically
from planner.grasps.grasp import Grasp
from planner.grasps.lift import in_space
from planner.objects.graspable import Graspable
from sim.report.report_data import plain_status, report_data

UNSAFE = {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}
"""Characters that could end a script, as JSON writes them otherwise."""


def report_page(rigid_object: Graspable, grasp: Grasp, file: str, validation: Mapping[str, Any] | None = None) -> str:
    """The page.

    Args:
        rigid_object: What is grasped; a planar object is shown as a slab.
        grasp: The grasp; where none was found, the page shows the candidates and what is proven about them.
        file: Name of its file.
        validation: The document of its validation file as plain values, where there is one.

    """
    data = json.dumps(report_data(*in_space(rigid_object, grasp), file, validation), allow_nan=False)
    scripts = {name: _part(f"{name}.js") for name in ("scene", "elements", "search", "panels")}
    parts = scripts | {
        "title": html.escape(f"{grasp.body}: {_outcome(grasp)}"),
        "style": _part("style.css"),
        "policy": _policy(list(scripts.values())),
        "data": "".join(UNSAFE.get(character, character) for character in data),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda mark: parts[mark[1]], _part("page.html"))


def write_report(
    path: Path, rigid_object: Graspable, grasp: Grasp, file: str, validation: Mapping[str, Any] | None = None
) -> None:
    """Write the page; see `report_page`.

    Raises:
        OutputError: When the file cannot be written.
    """
    write_atomically(path, report_page(rigid_object, grasp, file, validation).encode())


def _outcome(grasp: Grasp) -> str:
    return f"grasp with {grasp.rho:.4g} N" if grasp.found else f"no grasp ({plain_status(grasp)})"


def _part(name: str) -> str:
    return files("sim.report").joinpath(name).read_text("utf-8")


def _policy(scripts: list[str]) -> str:
    """No requests at all, and only these scripts."""
    hashes = (base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts)
    allowed = " ".join(f"'sha256-{digest}'" for digest in hashes)
    return f"default-src 'none'; style-src 'unsafe-inline'; script-src {allowed}"
