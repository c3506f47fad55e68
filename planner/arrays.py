"""What arrays hold, for the type checker; shapes and units stand in docstrings."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
"""Lengths, forces, directions: real numbers."""

Indices = NDArray[np.integer]
"""Whole numbers: places in other arrays, or counts."""

Mask = NDArray[np.bool_]
"""Whether or not, element by element."""

Singles = NDArray[np.float32]
"""Real numbers in single precision, where a table is large or MuJoCo asks for them."""

Pixels = NDArray[np.uint8]
"""Red, green and blue from 0 to 255."""
