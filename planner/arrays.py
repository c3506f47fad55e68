"""What arrays hold, for the type checker; shapes and units stand in docstrings."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
"""Lengths, forces, directions: real numbers."""

Indices = NDArray[np.integer]
"""Places in other arrays."""

Mask = NDArray[np.bool_]
"""Whether or not, element by element."""

Singles = NDArray[np.float32]
"""Real numbers in single precision, where a table is large."""
