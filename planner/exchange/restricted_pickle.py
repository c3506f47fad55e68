"""Foreign `.npy` files with a pickled dictionary inside, read without running anything they bring along.

A pickle may name any function and have it called. Here only the four names that arrays, their element types and
their scalars need are known; a file that names anything else is refused before it is called.
"""

import io
import pickle
from pathlib import Path
from typing import Any

import numpy as np

from planner.errors import GraspFileError
from planner.files.bounded_read import read_bounded

MAX_BYTES = 2**26
"""Largest file that is read."""

RECONSTRUCT = np.ndarray(0).__reduce__()[0]
SCALAR = np.float64(0).__reduce__()[0]

KNOWN: dict[tuple[str, str], object] = {
    ("numpy", "ndarray"): np.ndarray,
    ("numpy", "dtype"): np.dtype,
} | {
    (module, name): function
    for module in ("numpy.core.multiarray", "numpy._core.multiarray")  # before and since NumPy 2
    for name, function in (("_reconstruct", RECONSTRUCT), ("scalar", SCALAR))
}
"""What a pickle may name."""


class ArraysOnly(pickle.Unpickler):
    """Knows NumPy's arrays and nothing else."""

    def find_class(self, module: str, name: str) -> object:
        """What a pickle names.

        Raises:
            UnpicklingError: When it is not of NumPy's arrays.
        """
        if (module, name) not in KNOWN:
            raise pickle.UnpicklingError(f"it names {module}.{name}; only NumPy arrays are read")
        return KNOWN[module, name]


def read_pickled_dictionary(path: Path) -> dict[str, Any]:
    """The dictionary that `numpy.save(path, dictionary)` has written.

    Raises:
        GraspFileError: When the file cannot be read, is too large, or holds anything but plain values and arrays.
    """
    content = io.BytesIO(read_bounded(path, MAX_BYTES, "grasp", GraspFileError))
    try:
        version = np.lib.format.read_magic(content)
        if version != (1, 0):
            raise GraspFileError(f"{path} has NPY version {version}; allowed: (1, 0)")
        shape, _, dtype = np.lib.format.read_array_header_1_0(content)
        if shape != () or dtype.kind != "O":
            raise GraspFileError(f"{path} holds an array of {dtype}, shape {shape}; expected one pickled dictionary")
        value = ArraysOnly(content).load().item()
    # What the machine of a broken pickle may raise; nothing of the file's own has run.
    except (pickle.UnpicklingError, EOFError, ValueError, TypeError, AttributeError, LookupError, MemoryError) as error:
        raise GraspFileError(f"{path} is not a grasp that can be read safely: {error}") from error
    if not isinstance(value, dict):
        raise GraspFileError(f"{path} holds a {type(value).__name__}; expected a dictionary")
    return value
