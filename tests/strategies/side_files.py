"""Grasp files as format version 1 had them: candidates and cuts in an archive of NumPy's beside the JSON."""

import hashlib
import io
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planner.arrays import Floats
from planner.grasps.grasp import Grasp
from planner.grasps.grasp_file import write_grasp


def arrays_of(grasp: Grasp) -> dict[str, Floats]:
    """What its side file holds."""
    candidates = grasp.certificate.candidates
    return {
        "positions": candidates.points,
        "normals": candidates.normals,
        "friction": candidates.friction,
        "cuts": grasp.certificate.cuts,
    }


def archived(arrays: dict[str, NDArray[Any]], *, pickled: bool = False) -> bytes:
    """A side file, as `numpy.savez_compressed` makes it."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            with archive.open(f"{name}.npy", "w") as stream:
                np.lib.format.write_array(stream, array, allow_pickle=pickled)
    return content.getvalue()


def write_with_side_file(path: Path, grasp: Grasp, side: bytes) -> Path:
    """The JSON file at `path`, the side file beside it; the latter's path."""
    write_grasp(path, grasp)
    beside = path.with_suffix(".npz")
    document: dict[str, Any] = json.loads(path.read_text())
    certificate = document["certificate"]
    del certificate["candidates"]
    certificate |= {
        "file": beside.name,
        "sha256": hashlib.sha256(side).hexdigest(),
        "cuts": len(grasp.certificate.cuts),
    }
    document["format_version"] = 1
    path.write_text(json.dumps(document))
    beside.write_bytes(side)
    return beside
